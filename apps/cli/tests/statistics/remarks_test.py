#!/usr/bin/env python3
"""Tests what a run says of its intervals and values on two lines F = k x and G = c x that a script computes: experiments
that scatter differently without stated noise, values off the least sum of squares, a bound within the noise, and weights
beside noise that is stated rightly.

   remarks_test.py PATH/TO/latsch"""
import json
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
    out.write("x [mm],F [N],G [N]\\n")
    for i in range(41):
        out.write(f"{i},{k * i!r},{c * i!r}\\n")
"""
STUDY = """[simulator]
command = ["%s", "lines.py"]
inputs = ["in.txt"]
files = ["lines.py"]
[simulator.output.o]
file = "out.csv"
reader = "table"
quantities = ["x [mm]", "F [N]", "G [N]"]
[variable.k]
lower = 50
upper = %s
initial = 100
[variable.c]
lower = 50
upper = 500
initial = 100
"""


class Remarks(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_remarks_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "lines.py").write_text(SCRIPT)
        (self.folder / "in.txt").write_text("{k} {c}")
        self.number = 0

    def measure(self, name, slope, noise, count, seed):
        chance = random.Random(seed)
        places = [1 + 38 * i / (count - 1) for i in range(count)]
        errors = [chance.gauss(0, noise) for _ in places]
        (self.folder / f"{name}.csv").write_text(
            f"x [mm],{name} [N]\n" + "".join(f"{x!r},{slope * x + e!r}\n" for x, e in zip(places, errors)))

    def experiment(self, name, more):
        return (f'[experiment.{name}]\nkind = "curve"\nx = "o/x"\ny = "o/{name}"\nmeasurement = "{name}.csv"\n' + more)

    def remarks(self, *experiments, upper="500"):
        """Runs a study of these experiments, and returns its remarks as one text."""
        self.number += 1
        study = self.folder / f"study{self.number}.toml"
        study.write_text(STUDY % (sys.executable, upper) + "".join(experiments))
        run = subprocess.run([LATSCH, "run", study, "--json", "--quiet"], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, DONE, run.stdout + run.stderr)
        return " ".join(json.loads(run.stdout)["result"]["remarks"])

    def test_experiments_that_share_one_spread_although_they_scatter_differently_are_named(self):
        self.measure("F", 200, 5, 12, 1)
        self.measure("G", 150, 600, 12, 2)
        squares = "exponent = 2\n"
        said = self.remarks(self.experiment("F", squares), self.experiment("G", squares))
        self.assertIn("all share one spread, but F scatters by", said)
        self.assertIn("too narrow. State the noise of each experiment", said)
        estimated = squares + 'noise = "estimated"\n'
        self.assertNotIn("share one spread", self.remarks(self.experiment("F", estimated), self.experiment("G", estimated)))
        self.measure("G", 200, 5, 12, 3)
        self.assertNotIn("share one spread", self.remarks(self.experiment("F", squares), self.experiment("G", squares)))

    def test_values_off_the_least_sum_of_squares_say_where_it_is(self):
        self.measure("F", 200, 100, 5, 1)
        self.measure("G", 150, 100, 5, 5)
        # A value far off moves the least squares and hardly the least mean error.
        with open(self.folder / "F.csv", "a") as file:
            file.write("39.5,9500\n")
        said = self.remarks(self.experiment("F", "exponent = 1\n"), self.experiment("G", "exponent = 1\n"))
        self.assertIn("least sum of squares, which is off by standard deviations of", said)
        squares = "exponent = 2\n"
        self.assertNotIn("which is off by", self.remarks(self.experiment("F", squares), self.experiment("G", squares)))

    def test_a_bound_within_the_noise_is_no_fault_of_the_bounds(self):
        self.measure("F", 200, 50, 12, 4)
        self.measure("G", 150, 50, 12, 5)
        known = 'exponent = 2\nnoise = "50 N"\n'
        self.assertNotIn("lie outside of the bounds",
                         self.remarks(self.experiment("F", known), self.experiment("G", known), upper="199.9"))
        self.assertIn("lie outside of the bounds",
                      self.remarks(self.experiment("F", known), self.experiment("G", known), upper="150"))

    def test_a_weight_beside_noise_that_is_stated_rightly_is_no_alarm(self):
        self.measure("F", 200, 50, 40, 6)
        self.measure("G", 150, 50, 40, 7)
        known = 'exponent = 2\nnoise = "50 N"\n'
        self.assertNotIn("times their stated noise",
                         self.remarks(self.experiment("F", known), self.experiment("G", known + "weight = 100\n")))


if __name__ == "__main__":
    unittest.main()
