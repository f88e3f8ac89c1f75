#!/usr/bin/env python3
"""Tests what a fit says of its own certainty on lines F = k t and G = c t over time that a script computes: intervals
within a linear equation, samples that count twice, nuisance numbers, the JSON of `latsch identify`, noise and loss in
`latsch check`, and filtered noise.

   certainty_test.py PATH/TO/latsch"""
import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH

SCRIPT = """k, c = (float(x) for x in open("in.txt").read().split())
with open("out.csv", "w") as out:
    out.write("time [s],Fy [N],Fx [N]\\n")
    for i in range(401):
        t = 0.01 * i
        out.write(f"{t!r},{k * t!r},{c * t!r}\\n")
"""
STUDY = """[simulator]
command = ["%s", "lines.py"]
inputs = ["in.txt"]
files = ["lines.py"]
[simulator.output.o]
file = "out.csv"
reader = "table"
quantities = ["time [s]", "Fy [N]", "Fx [N]"]
[variable.k]
lower = 50
upper = 500
initial = 100
[variable.c]
lower = 50
upper = 500
initial = 250
"""
SUM = '[linear_constraint.sum]\nvariables = ["k", "c"]\nequal = 350\n'


class Certainty(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_certainty_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "lines.py").write_text(SCRIPT)
        (self.folder / "in.txt").write_text("{k} {c}")
        self.number = 0

    def measure(self, name, channel, slope, errors, step=0.1):
        """Records slope t and an error at t = step, 2 step, ..."""
        rows = "".join(f"{step * (i + 1)!r},{slope * step * (i + 1) + e!r}\n" for i, e in enumerate(errors))
        (self.folder / f"{name}.csv").write_text(f"time [s],{channel} [N]\n{rows}")
        return [step * (i + 1) for i in range(len(errors))]

    def noise(self, deviation, count, seed):
        chance = random.Random(seed)
        return [chance.gauss(0, deviation) for _ in range(count)]

    def experiment(self, name, channel, measurement, more=""):
        return (f'[experiment.{name}]\nkind = "curve"\nx = "o/time"\ny = "o/{channel}"\nmeasurement = "{measurement}"\n'
                f"exponent = 2\n{more}")

    def study(self, *parts):
        self.number += 1
        study = self.folder / f"study{self.number}.toml"
        study.write_text(STUDY % sys.executable + "".join(parts))
        return study

    def latsch(self, *arguments):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=200)
        self.assertEqual(run.returncode, DONE, run.stdout + run.stderr)
        return run.stdout if "--json" in arguments else run.stdout + run.stderr

    def answer(self, verb, study):
        return json.loads(self.latsch(verb, study, "--json", "--quiet"))["result"]

    def test_intervals_keep_to_a_linear_equation(self):
        """With c = 350 - k the variance of both is sigma^2 / sum of all t^2."""
        at = self.measure("F", "Fy", 200, self.noise(5, 30, 1)) + self.measure("G", "Fx", 150, self.noise(5, 20, 2))
        known = 'noise = "5 N"\n'
        study = self.study(SUM, self.experiment("F", "Fy", "F.csv", known), self.experiment("G", "Fx", "G.csv", known))
        half = 1.959964 * 5 / math.sqrt(sum(t * t for t in at))
        for verb in ("run", "identify"):
            answer = self.answer(verb, study)
            self.assertIn("keep the linear constraint sum", " ".join(answer["remarks"]))
            self.assertNotIn("ended early", " ".join(answer["remarks"]))
            for variable in answer["variables"]:
                low, high = variable["interval"]
                self.assertAlmostEqual((high - low) / 2, half, delta=0.01 * half)
                self.assertEqual(variable["interval_from"], "data")
            matrix = answer["correlations"]["matrix"]
            self.assertAlmostEqual(matrix[0][1], -1, delta=1e-6)
            self.assertEqual(len(answer["directions"]), 1)
        for profile in answer["profiles"]:
            low, high = profile["interval"]
            self.assertAlmostEqual((high - low) / 2, half, delta=0.02 * half)
            self.assertEqual(profile["verdict"], "identifiable")

    def test_samples_that_count_twice_are_told(self):
        self.measure("F", "Fy", 200, self.noise(5, 30, 1))
        both = '[measurement.one]\nfile = "F.csv"\n[measurement.two]\nfile = "F.csv"\n%s'
        parts = self.experiment("A", "Fy", "one"), self.experiment("B", "Fy", "two")
        said = 'experiments "A" and "B" compare the same file "F.csv": %d of its samples count twice'
        for verb in ("check", "run"):
            self.assertIn(said % 30, self.latsch(verb, self.study(both % "", *parts)))
        self.assertIn(said % 15, self.latsch("check", self.study(both % "every = 2\n", *parts)))
        halves = '[measurement.one]\nfile = "F.csv"\nselect = {time = ".. 1.55 s"}\n[measurement.two]\nfile = "F.csv"\n' \
                 'select = {time = "1.56 s .."}\n'
        self.assertNotIn("count twice", self.latsch("check", self.study(halves, *parts)))

    def test_json_has_what_the_terminal_prints(self):
        self.measure("F", "Fy", 200, self.noise(5, 30, 1))
        self.measure("G", "Fx", 150, self.noise(5, 30, 2))
        known = 'noise = "5 N"\n'
        study = self.study(self.experiment("F", "Fy", "F.csv", known + 'nuisance = {offset = "10 N"}\n'),
                           self.experiment("G", "Fx", "G.csv", known))
        self.assertEqual({"correlations", "directions", "nuisance", "nuisance_costs"} - set(self.answer("run", study)), set())
        answer = self.answer("identify", study)
        self.assertEqual([p["variable"] for p in answer["profiles"]], ["k", "c"])
        for profile, variable in zip(answer["profiles"], answer["variables"]):
            self.assertEqual(variable["unit"], profile["unit"])
            rises = [p["rise"] for p in profile["points"]]
            values = [p["value"] for p in profile["points"]]
            self.assertEqual(values, sorted(values))
            self.assertAlmostEqual(min(rises), 0, delta=1e-6)
            self.assertGreater(rises[0], 1)
            self.assertGreater(rises[-1], 1)
            self.assertLess(values[0], profile["interval"][0])
        self.assertEqual(answer["correlations"]["variables"], ["k", "c"])
        self.assertAlmostEqual(answer["correlations"]["matrix"][0][0], 1)
        self.assertEqual([r["experiment"] for r in answer["left_out"]], ["F", "G"])
        gains = answer["repetitions"]
        self.assertEqual([g["shrinkage"] for g in gains], sorted((g["shrinkage"] for g in gains), reverse=True))
        self.assertIn(gains[0]["helps"], ("k", "c"))
        self.assertGreater(gains[0]["before"], gains[0]["after"])
        number, = answer["nuisance"]
        self.assertEqual((number["number"], number["unit"], number["prior"], number["shared"], number["is_determined"]),
                         ("offset", "N", 10.0, None, True))
        cost = answer["nuisance_costs"][0]
        self.assertEqual((cost["variable"], cost["unit"]), ("k", "1"))
        self.assertGreater(cost["solved"][1] - cost["solved"][0], cost["known"][1] - cost["known"][0])

    def test_solved_numbers_may_take_slow_noise_out_of_the_fit(self):
        """The intervals beside known numbers use the same noise. They are wider if slow noise acts like an offset."""
        def widths(seed, kappa, more=""):
            chance, slow = random.Random(seed), [0.0]
            slow[0] = chance.gauss(0, 5)
            errors = []
            for _ in range(60):
                slow.append(kappa * slow[-1] + math.sqrt(1 - kappa ** 2) * chance.gauss(0, 5))
                errors.append(slow[-1])
            self.measure("F", "Fy", 200, errors, step=0.06)
            study = self.study(self.experiment("F", "Fy", "F.csv", more + 'nuisance = {offset = "free"}\n'))
            study.write_text(study.read_text().replace("[variable.c]\nlower = 50\nupper = 500\ninitial = 250\n", ""))
            (self.folder / "in.txt").write_text("{k}")
            (self.folder / "lines.py").write_text(SCRIPT.replace("k, c = (float(x) for x in ", "k, c = (float(x) for x in 2 * "))
            answer = self.answer("run", study)
            cost, = answer["nuisance_costs"]
            return [cost[key][1] - cost[key][0] for key in ("solved", "known")], answer.get("nuisance_remarks", [])

        said = "k: narrower than if the numbers were known, because neighboring values share noise"
        (solved, known), remarks = widths(1, 0.99, 'noise = "5 N"\n')
        self.assertLess(solved, known)
        self.assertIn(said, " ".join(remarks))
        # The numbers that the noise of the fit gives; noise estimated beside a known offset gave 7.3.
        (solved, known), remarks = widths(1, 0.9)
        self.assertAlmostEqual(known, 11.8, delta=0.4)
        self.assertGreater(solved, known)
        self.assertEqual(remarks, [])

    def test_json_of_an_open_number_says_so(self):
        self.measure("F", "Fy", 200, self.noise(5, 30, 1))
        self.measure("G", "Fx", 150, self.noise(5, 30, 2))
        known = 'noise = "5 N"\n'
        study = self.study(self.experiment("F", "Fy", "F.csv", known + 'nuisance = {gain = "free"}\n'),
                           self.experiment("G", "Fx", "G.csv", known))
        answer = self.answer("run", study)
        self.assertIn("k and the gain of F act alike; give one a prior", answer["nuisance_remarks"])
        self.assertFalse(answer["nuisance"][0]["is_determined"])

    def test_a_check_names_noise_and_loss(self):
        self.measure("F", "Fy", 200, self.noise(5, 30, 1))
        for more, says in (('noise = "5 N + 2 %"\n', "noise 5 N + 2 %"), ('noise = "estimated"\n', "noise estimated"),
                           ('noise = "5 N"\nloss = "huber"\n', "loss huber, scale 1.345 deviations"),
                           ("", "noise not stated")):
            with self.subTest(more):
                self.assertIn(says, self.latsch("check", self.study(self.experiment("F", "Fy", "F.csv", more))))

    def test_noise_that_a_spectrum_does_not_use_is_told(self):
        self.measure("F", "Fy", 0, self.noise(5, 300, 1), step=0.01)
        table = '[measurement.m]\nfile = "F.csv"\nnoise = {Fy = "5 N"}\n'
        said = "compares a spectrum, so it does not use the noise that measurement.m states for the samples of Fy"
        self.assertIn(said, self.latsch("check", self.study(table, self.experiment("F", "Fy", "m", 'compare = "psd"\n'))))
        self.assertNotIn(said, self.latsch("check", self.study(table, self.experiment("F", "Fy", "m"))))

    def test_filtered_noise_is_not_only_a_misfit(self):
        self.measure("F", "Fy", 200, self.noise(5, 390, 1), step=0.01)
        filtered = '[measurement.m]\nfile = "F.csv"\nlow_pass = "4 Hz"\n'
        said = self.answer("run", self.study(filtered, self.experiment("F", "Fy", "m")))["remarks"]
        self.assertIn("The measurement of F is low-passed, which makes its noise smooth", " ".join(said))

    def test_noise_that_cancels_counts_as_more_values(self):
        chance = random.Random(4)
        errors = [chance.gauss(0, 5) for _ in range(201)]
        self.measure("F", "Fy", 200, [b - a for a, b in zip(errors, errors[1:])], step=0.015)
        said = " ".join(self.answer("run", self.study(self.experiment("F", "Fy", "F.csv")))["remarks"])
        self.assertIn("count them as correspondingly more values", said)
        self.assertNotIn("fewer values", said)


if __name__ == "__main__":
    unittest.main()
