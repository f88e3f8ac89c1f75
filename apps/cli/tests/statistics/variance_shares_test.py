#!/usr/bin/env python3
"""Tests shares of the variance from a design of experiments.

   variance_shares_test.py PATH/TO/latsch"""
import json
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, WRONG_INPUT, Outside

PROGRAM = """
import sys
a, b, c = (float(line.split("=")[1]) for line in open("in.txt"))
if a + b > {limit}:
    sys.exit("broken")
open("out.csv", "w").write("y [N], z [N]\\n%r, 5\\n" % (3 * a + 4 * b))
"""
STUDY = """
[simulator]
command = ["python3", "program.py"]
inputs = ["in.txt"]
files = ["program.py"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["y [N]", "z [N]"]
[variable.a]
lower = 0
upper = 1
initial = 0.5
[variable.b]
lower = 0
upper = 1
initial = 0.5
[variable.c]
lower = 0
upper = 1
initial = 0.5
[experiment.y]
kind = "values"
channel = "out/y"
value = "3 N"
[experiment.z]
kind = "values"
channel = "out/z"
value = "5 N"
[doe]
design = "latin_hypercube"
points = 40
effects = "sobol"
"""


class VarianceShares(Outside):
    def study_of(self, text=STUDY, limit=9):
        (self.folder / "program.py").write_text(PROGRAM.format(limit=limit))
        (self.folder / "in.txt").write_text("a = {a}\nb = {b}\nc = {c}\n")
        file = self.folder / "study.toml"
        file.write_text(text)
        return file

    def told(self, file):
        run = subprocess.run([LATSCH, "doe", file, "--json"], capture_output=True, text=True)
        self.assertEqual(run.returncode, DONE, run.stderr)
        return json.loads(run.stdout)["result"]

    def test_a_linear_response_has_the_squares_of_its_slopes_as_shares(self):
        told = {one["response"]: one for one in self.told(self.study_of())["shares"]}
        self.assertEqual(set(told), {"target", "value of y", "value of z"})
        self.assertTrue(told["value of z"]["constant"])
        y = told["value of y"]
        self.assertAlmostEqual(y["explained"], 1.0, places=9)
        for one, expected in zip(y["variables"], (9 / 25, 16 / 25, 0)):
            self.assertAlmostEqual(one["first"], expected, places=9, msg=one["name"])
            self.assertAlmostEqual(one["total"], expected, places=9, msg=one["name"])
        self.assertIn("Sobol", (self.folder / "study.html").read_text())

    def test_too_many_failures_are_a_reason(self):
        told = self.told(self.study_of(limit=1.2))
        self.assertRegex(told["shares_refused"], r"\d+ of 40 points have no target, more than a fifth")
        self.assertNotIn("shares", told)

    def test_wrong_designs_are_refused(self):
        for old, new, said in (('points = 40', 'points = 12', "expected at least 20"),
                               ('"latin_hypercube"', '"morris"', "effects of its own"),
                               ('"latin_hypercube"\npoints = 40', '"full_factorial"\nlevels = 3', "effects"),
                               ('effects = "sobol"', 'effects = "sobols"', "sobol")):
            file = self.study_of(STUDY.replace(old, new))
            self.assertIn(said, self.latsch("doe", file, code=WRONG_INPUT))


if __name__ == "__main__":
    unittest.main()
