#!/usr/bin/env python3
"""Tests `latsch design` on the side force of a tire with known coefficients: the tests that it chooses run, promise what
they keep, and wrong input is refused in one sentence.

   design_test.py PATH/TO/latsch"""
import csv
import io
import json
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

TRUTH = {"PCY1": 1.5, "PDY1": 1.25, "PEY1": -0.8, "PKY1": -32.0, "PKY2": 1.9}
START = {"PCY1": 1.4, "PDY1": 1.1, "PEY1": -0.5, "PKY1": -25.0, "PKY2": 1.6}
NOISE = 5.0  # N
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
DESIGN = """[design]
test = "steady"
settings = {Fz = ["500 N", "2800 N"], alpha = ["-10 deg", "10 deg"]}
limits = ["Fz * abs(alpha) <= 15 kN deg"]
cost = {Fz = 3}
count = 6
"""


def inverse(matrix):
    """Returns the inverse of a small matrix by elimination with pivots."""
    count = len(matrix)
    rows = [list(row) + [float(i == j) for j in range(count)] for i, row in enumerate(matrix)]
    for i in range(count):
        pivot = max(range(i, count), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for k in range(count):
            if k != i:
                rows[k] = [a - rows[k][i] * b for a, b in zip(rows[k], rows[i], strict=True)]
    return [row[count:] for row in rows]


class Design(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_design_"))
        self.addCleanup(shutil.rmtree, self.base)
        (self.base / "tire.tir").write_text(TIR + "".join(f"{k} = {v}\n" for k, v in START.items()))
        self.study = self.base / "study.toml"
        self.states = [(Fz, alpha) for Fz in (1200, 2400) for alpha in range(-4, 5)]  # too small for the peak
        rows = self.forces(self.states)
        chance = random.Random(1)
        (self.base / "first.csv").write_text("Fz [N],alpha [deg],Fy [N]\n" + "".join(
            f"{Fz},{alpha},{force + chance.gauss(0, NOISE)}\n" for (Fz, alpha), force in zip(self.states, rows, strict=True)))
        self.study.write_text(
            'model = "tire.tir"\n' + f"vary = {json.dumps(list(TRUTH))}\n"
            'measurement.first = {file = "first.csv", axes = "iso"}\n'
            'test.steady = {kind = "steady_states", states = {from = "measurement.first"}}\n'
            'experiment.first = {kind = "curve", y = "steady/Fy", measurement = "first", exponent = 2, '
            f'noise = "{NOISE} N"}}\n' + DESIGN)

    def forces(self, states, **changed):
        """Returns the side force of the true tire, with some coefficients changed, in states of load and slip angle."""
        coefficients = {**TRUTH, **changed}
        (self.base / "truth.tir").write_text(TIR + "".join(f"{k} = {v}\n" for k, v in coefficients.items()))
        Fz, alpha = (", ".join(f'"{state[i]} {unit}"' for state in states) for i, unit in enumerate(("N", "deg")))
        recorded = self.base / "forces.csv"
        self.latsch("test", self.base / "truth.tir",
                    f'{{kind = "steady_states", states = {{Fz = [{Fz}], alpha = [{alpha}]}}}}', "-o", recorded)
        return [float(row["Fy [N]"]) for row in csv.DictReader(io.StringIO(recorded.read_text()))]

    def half_widths(self, states):
        """Returns the half widths of 95 % intervals by the slopes at the truth, from differences."""
        columns = []
        for name, value in TRUTH.items():
            step = 1e-4 * abs(value)
            pairs = zip(self.forces(states, **{name: value + step}), self.forces(states, **{name: value - step}),
                        strict=True)
            columns.append([(up - down) / (2 * step * NOISE) for up, down in pairs])
        C = inverse([[sum(a * b for a, b in zip(x, y, strict=True)) for y in columns] for x in columns])
        return {name: 1.96 * C[i][i] ** 0.5 for i, name in enumerate(TRUTH)}

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout if code == DONE else run.stdout + run.stderr

    def answer(self, *arguments):
        return json.loads(self.latsch(*arguments, "--json"))["result"]

    def refusal(self, pattern, new):
        text = self.study.read_text()
        edit(self.study, (pattern, new))
        said = self.latsch("design", self.study, code=WRONG_INPUT)
        self.study.write_text(text)
        return said

    def test_the_tests_stay_inside_the_limits_run_and_narrow_what_was_open(self):
        self.latsch("run", self.study)
        found = self.answer("design", self.study)
        self.assertEqual(len(found["tests"]), 6)
        self.assertEqual(found["after"], [0, 4, 6])
        for test in found["tests"]:
            Fz, alpha = test["settings"]["Fz"]["value"], test["settings"]["alpha"]["value"]
            self.assertLessEqual(Fz * abs(alpha), 15e3 * (1 + 1e-6))
            self.assertTrue(500 <= Fz <= 2800 and -10 <= alpha <= 10)
        self.assertAlmostEqual(found["noise"][0], NOISE, delta=1e-6)
        self.assertLess(found["mean_over_now"][2], found["mean_over_now"][1])
        self.assertLess(found["grid"]["interval_ratio"], 1.0)
        recorded = self.base / "recorded.csv"
        self.latsch("test", self.study, self.base / "study.design" / found["tests"][0]["file"], "-o", recorded)
        [row] = csv.DictReader(io.StringIO(recorded.read_text()))
        self.assertAlmostEqual(float(row["Fz [N]"]), found["tests"][0]["settings"]["Fz"]["value"], places=6)
        table = (self.base / "study.design.csv").read_text().splitlines()
        self.assertEqual(table[0], "test,rank,file,Fz [N],alpha [deg]")
        self.assertEqual(len(table), 7)
        # workers change no design
        self.assertEqual(self.answer("design", self.study, "--workers", "3")["tests"], found["tests"])

    def test_a_campaign_keeps_what_it_promises(self):
        self.latsch("run", self.study)
        found = self.answer("design", self.study, "--count", "12")
        tests = [(t["settings"]["Fz"]["value"], t["settings"]["alpha"]["value"]) for t in found["tests"]]
        exact = self.half_widths(self.states + tests)
        forces = self.forces(tests)
        chance = random.Random(2)
        first = (self.base / "first.csv").read_text()
        (self.base / "first.csv").write_text(first + "".join(
            f"{Fz},{alpha},{force + chance.gauss(0, NOISE)}\n" for (Fz, alpha), force in zip(tests, forces, strict=True)))
        self.study.with_suffix(".latsch").unlink()
        fitted = self.answer("run", self.study)
        for variable in fitted["variables"]:
            promised = found["variables"][variable["name"]]["half_widths"][-1]
            # the promise uses the slopes at the first fit, which is off by its noise of 0.3 %
            self.assertAlmostEqual(promised / exact[variable["name"]], 1.0, delta=0.05, msg=variable["name"])
            # three half widths of 95 % are six deviations
            self.assertLess(abs(variable["value"] - TRUTH[variable["name"]]), 3 * promised, variable["name"])

    def test_a_rival_model_is_told_apart(self):
        self.latsch("run", self.study)
        rival = self.base / "rival.toml"
        rival.write_text(re.sub(r"\[design\](.|\n)*", "", self.study.read_text()).replace('"PEY1", ', ""))
        edit(self.study, ("count = 6", 'count = 6\ncriterion = "T"\nagainst = "rival.toml"'))
        found = self.answer("design", self.study)
        self.assertEqual(found["T"][0], 0.0)
        self.assertGreater(found["T"][-1], 0.0)
        self.assertGreaterEqual(found["grid"]["criterion_ratio"], 0.99)

    def test_wrong_input_is_refused_in_a_sentence(self):
        said = self.latsch("design", self.study, code=WRONG_INPUT)  # not fitted, no prior
        self.assertIn("latsch run", said)
        self.assertIn('did you mean "alpha"?', self.refusal("alpha = ", "alhpa = "))
        self.assertIn("is not a number of the test steady", self.refusal("alpha = ", "camber = "))
        self.assertIn("compares N with rad", self.refusal(r"Fz \* abs\(alpha\) <= 15 kN deg", "Fz <= 15 deg"))
        self.assertIn("against is missing", self.refusal("count = 6", 'criterion = "T"'))
        self.assertIn("of is missing", self.refusal("count = 6", 'criterion = "I"'))
        self.assertIn("count", self.refusal("count = 6", "count = 0"))
        self.assertIn("--count", self.latsch("design", self.study, "--count", "0", code=WRONG_INPUT))
        edit(self.study, (r"\[design\](.|\n)*", ""))
        self.assertIn("has no [design]", self.latsch("design", self.study, code=WRONG_INPUT))

    def test_a_file_of_somebody_else_stays_and_nothing_is_written(self):
        self.latsch("run", self.study)
        mine = self.base / "mine"
        mine.mkdir()
        (mine / "test_02.toml").write_text("kind = 'mine'\n")
        said = self.latsch("design", self.study, "-o", mine, code=WRONG_INPUT)
        self.assertIn("test_02.toml\" was not written by latsch design", said)
        self.assertEqual([file.name for file in mine.iterdir()], ["test_02.toml"])
        self.assertFalse((self.base / "study.design.csv").exists())

    def test_limits_that_leave_nothing_are_told(self):
        self.latsch("run", self.study)
        self.assertIn("leave no settings", self.refusal("<= 15 kN deg", "<= -1 kN deg"))


if __name__ == "__main__":
    unittest.main()
