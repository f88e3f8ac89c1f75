#!/usr/bin/env python3
"""Tests noise = "estimated": the unknown standard deviations of two experiments are estimated together with the
variables. The data are side force and aligning moment of a tire with known coefficients, with noise of 1 % and of 6 %
of their largest values.

   estimated_noise_test.py PATH/TO/latsch"""
import csv
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, WRONG_INPUT, edit

TRUTH = {"PCY1": 1.5, "PDY1": 1.25, "PDY2": -0.12, "PEY1": -0.8, "PKY1": -32.0, "PKY2": 1.9,
         "QBZ1": 9.0, "QCZ1": 1.15, "QDZ1": 0.11, "QEZ1": -1.5}
START = {"PCY1": 1.4, "PDY1": 1.1, "PDY2": 0.0, "PEY1": -0.5, "PKY1": -25.0, "PKY2": 1.6,
         "QBZ1": 8.0, "QCZ1": 1.2, "QDZ1": 0.1, "QEZ1": -1.0}
NOISE = {"Fy": 0.01, "Mz": 0.06}  # shares of the largest value
TIR = """[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
[MODEL]
FITTYP = 61
LONGVL = 11.11
[DIMENSION]
UNLOADED_RADIUS = 0.2032
[VERTICAL]
FNOMIN = 1600
VERTICAL_STIFFNESS = 218000
[COEFFICIENTS]
"""


class EstimatedNoise(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_noise_"))
        self.addCleanup(shutil.rmtree, self.base)
        (self.base / "tire.tir").write_text(TIR + "".join(f"{k} = {v}\n" for k, v in TRUTH.items()))
        self.record()
        (self.base / "tire.tir").write_text(TIR + "".join(f"{k} = {v}\n" for k, v in START.items()))
        self.study = self.base / "study.toml"
        self.study.write_text(
            'model = "tire.tir"\n' + f"vary = {json.dumps(list(TRUTH))}\n"
            'measurement.sweeps = {file = "sweeps.csv"}\n'
            'test.steady = {kind = "steady_states", states = {from = "measurement.sweeps"}}\n' +
            "".join(f'experiment.{c} = {{kind = "curve", y = "steady/{c}", measurement = "sweeps", exponent = 2, '
                    'noise = "estimated"}\n' for c in NOISE))

    def record(self):
        states = [(Fz, math.radians(12 * math.sin(2 * math.pi * i / 60))) for Fz in (500, 1600, 2600)
                  for i in range(60)]
        head = "Fz [N],alpha [rad]"
        (self.base / "states.csv").write_text(head + "\n" + "".join(f"{F},{a!r}\n" for F, a in states))
        self.latsch("test", self.base / "tire.tir",
                    f'{{kind = "steady_states", states = "{self.base / "states.csv"}"}}', "-o", self.base / "out.csv",
                    "--quiet")
        with open(self.base / "out.csv") as file:
            table = list(csv.reader(line for line in file if not line.startswith("#")))
        names = [cell.split(" ")[0] for cell in table[0]]
        chance, columns = random.Random(7), {}
        for c, share in NOISE.items():
            true = [float(row[names.index(c)]) for row in table[1:]]
            deviation = share * max(map(abs, true))
            columns[c] = [x + chance.gauss(0, deviation) for x in true]
        (self.base / "sweeps.csv").write_text(head + ",Fy [N],Mz [N m]\n" + "".join(
            f"{F},{a!r},{Fy!r},{Mz!r}\n" for (F, a), Fy, Mz in zip(states, columns["Fy"], columns["Mz"])))

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout if code == DONE else run.stderr

    def variables(self, *arguments):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch(*arguments, "--json"))
        found = {v["name"]: v for v in answer["result"]["variables"]}
        for one in found.values():  # null for an open end
            lower, upper = one["interval"]
            one["interval"] = (-math.inf if lower is None else lower, math.inf if upper is None else upper)
        return found

    def test_deviations_and_variables_are_found_together(self):
        text = self.latsch("run", self.study)
        noise = re.findall(r"Noise, as the stage before leaves it: Fy ([\d.]+) %, Mz ([\d.]+) %", text)
        self.assertEqual(len(noise), 2, text)  # two further rounds after the round with equal weights
        for found, (channel, true) in zip(noise[-1], NOISE.items()):
            # The estimate from 180 values has a standard deviation of 1 / sqrt(360) = 5 %; the largest measured value
            # includes noise.
            self.assertAlmostEqual(float(found) / 100, true, delta=0.15 * true, msg=channel)
        found = self.variables("resume", self.study)
        inside = sum(v["interval"][0] <= TRUTH[k] <= v["interval"][1] for k, v in found.items())
        self.assertGreaterEqual(inside, len(TRUTH) - 1)  # 95 % each

        # With these standard deviations stated in the study the fit is the same. So are the intervals, except that
        # the noise now counts as known.
        stated = self.base / "stated.toml"
        stated.write_text(self.study.read_text())
        for channel, share in zip(NOISE, noise[-1]):
            edit(stated, (rf'(experiment\.{channel} .*)noise = "estimated"', rf'\1noise = "{share} %"'))
        for name, one in self.variables("run", stated).items():
            width = found[name]["interval"][1] - found[name]["interval"][0]
            if math.isinf(width):
                continue
            self.assertAlmostEqual(one["value"], found[name]["value"], delta=0.05 * width, msg=name)
            self.assertAlmostEqual(one["interval"][1] - one["interval"][0], width, delta=0.25 * width, msg=name)

        # With equal weights the noise of the moment disturbs the fitted force.
        alike = self.base / "alike.toml"
        alike.write_text(self.study.read_text().replace(', noise = "estimated"', ""))
        wide = self.variables("run", alike)["PKY1"]["interval"]
        narrow = found["PKY1"]["interval"]
        self.assertGreater(wide[1] - wide[0], 1.5 * (narrow[1] - narrow[0]))

    def test_every_reader_of_the_journal_has_the_same_weights(self):
        first = self.variables("run", self.study)
        self.assertEqual(first, self.variables("resume", self.study))
        identified = self.variables("identify", self.study)
        self.latsch("report", self.study)
        self.latsch("export", self.study, "--model", self.base / "fitted.tir")
        fitted = (self.base / "fitted.tir").read_text()
        for name, one in first.items():
            self.assertEqual(one["value"], identified[name]["value"], name)
            for a, b in zip(one["interval"], identified[name]["interval"]):
                # One run uses derivatives, the other finite differences; a few values are hardly determined by the
                # data.
                self.assertTrue(a == b or abs(a - b) < 0.01 * abs(a - one["value"]), name)
            self.assertAlmostEqual(float(re.search(rf"^{name} *= *(\S+)", fitted, re.M)[1]), one["value"], places=12)

    def test_the_experiment_whose_stated_noise_is_wrong_is_named(self):
        text = self.study.read_text()
        self.study.write_text(text.replace('noise = "estimated"', 'noise = "1 %"'))
        self.assertRegex(self.latsch("run", self.study), r"times their stated noise \(by source Mz 6(\.\d)?, Fy (1|0\.9)")
        self.study.write_text(text.replace('noise = "estimated"', 'noise = "1 %"', 1).replace("estimated", "30 %"))
        self.assertRegex(self.latsch("run", self.study, "--anew"), r"much less than their stated noise: Mz 0\.\d+ times")

    def test_a_prior_that_the_data_contradict_is_named(self):
        text = self.study.read_text().replace('noise = "estimated"', 'noise = "1 %"', 1).replace("estimated", "6 %")
        self.study.write_text(text.replace('"PDY1", ', "") + "[variable.PDY1]\npath = \"PDY1\"\nlower = 0.5\nupper = 6\n"
                              "initial = 1.2\nprior = 5\nprior_sigma = 0.2\n")
        self.assertRegex(self.latsch("run", self.study), r"stated noise \(by source prior of PDY1 1\d")

    def test_what_cannot_be_estimated_is_said(self):
        text = self.study.read_text()
        self.study.write_text(text.replace('"estimated"', '"1 %"', 1))
        self.assertIn('is not "estimated", but that of another experiment is', self.latsch("check", self.study, code=2))
        self.study.write_text(text.replace('"estimated"', '"estimated", loss = "huber"', 1))
        self.assertIn('loss is given beside noise = "estimated"', self.latsch("check", self.study, code=WRONG_INPUT))


if __name__ == "__main__":
    unittest.main()
