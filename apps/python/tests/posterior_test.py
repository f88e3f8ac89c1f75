#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests samples of a posterior density from Python against a density that is known in closed form, and their errors."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

os.environ.setdefault("LATSCH_PROGRAM", sys.argv[1] if len(sys.argv) > 1 else "latsch")

import latsch  # noqa: E402
import numpy as np  # noqa: E402
from python_testing import LATSCH  # noqa: E402, F401

# Source text of an external program whose value is linear in a, so that a has a normal density.
PROGRAM = """
a = float(open("a.txt").read().split("=")[1])
open("out.csv", "w").write("y [N]\\n%r\\n" % (2 * a))
"""
STUDY = """
[simulator]
command = ["python3", "program.py"]
inputs = ["a.txt"]
files = ["program.py"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["y [N]"]
[variable.a]
lower = "0 mm"
upper = "1000 mm"
initial = "500 mm"
[experiment.e]
kind = "values"
channel = "out/y"
value = "0.9 N"
noise = "0.06 N"
[run]
workers = 1
"""
MEAN, DEVIATION = 0.45, 0.03  # m: 0.9 N and 0.06 N over 2 N/m; the program is given millimeters


class Posteriors(unittest.TestCase):
    def study(self, text=STUDY):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_posterior_"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "program.py").write_text(PROGRAM.replace("2 * a", "0.002 * a"))
        (folder / "a.txt").write_text("a = {a}\n")
        (folder / "study.toml").write_text(text)
        return latsch.read_study(folder / "study.toml")

    def test_samples_of_a_linear_model_are_normal(self):
        study = self.study()
        self.assertIsNone(study.samples(), "nothing was run yet")
        study.run(progress=False)
        lines = []
        posterior = study.sample(progress=lines.append)
        self.assertTrue(any("surrogate" in line for line in lines), lines)
        self.assertEqual((posterior.names, posterior.mixed, posterior.verdict, posterior.method), (["a"], True, "stands", "surrogate"))
        self.assertEqual(posterior.points.shape, (len(posterior), 1))
        self.assertEqual(posterior.log_densities.shape, posterior.chains.shape)
        self.assertAlmostEqual(posterior.center[0], MEAN, delta=1e-3 * DEVIATION)
        # 2000 draws, neighbors of a chain depend on each other: about 0.04 deviations for a median, 0.08 for an end
        self.assertAlmostEqual(posterior.medians[0], MEAN, delta=0.12 * DEVIATION)
        for own, linear, sign in zip(posterior.intervals[0], posterior.linear[0], (-1, 1)):
            self.assertAlmostEqual(own, MEAN + sign * 1.96 * DEVIATION, delta=0.25 * DEVIATION)
            self.assertAlmostEqual(linear, MEAN + sign * 1.96 * DEVIATION, delta=0.01 * DEVIATION)
        self.assertEqual(posterior.shapes, ["as the linear interval"])
        # the logarithm of a normal density is a parabola
        drop = -0.5 * ((posterior["a"] - MEAN) / DEVIATION) ** 2
        np.testing.assert_allclose(posterior.log_densities - posterior.log_densities.max(), drop - drop.max(), atol=1e-3)
        again = study.samples()
        np.testing.assert_array_equal(again.points, posterior.points)
        self.assertEqual(again.trials, posterior.trials)
        with self.assertRaisesRegex(KeyError, "b is none of the sampled variables a"):
            posterior["b"]

    def test_samples_in_memory_are_those_of_the_file(self):
        study = self.study()
        study.run(progress=False)
        posterior = study.sample(progress=False)
        file = study.file.with_name("study.samples.csv")
        columns = np.genfromtxt(file, delimiter=",", skip_header=1, usecols=(0, 1, 2))
        np.testing.assert_allclose(columns[:, 0] * 1e-3, posterior["a"], rtol=1e-11)
        np.testing.assert_allclose(columns[:, 1], posterior.log_densities, rtol=1e-11)
        np.testing.assert_array_equal(columns[:, 2], posterior.chains)

    def test_errors_have_the_sentence_of_the_command(self):
        unfitted = self.study()
        with self.assertRaisesRegex(latsch.InputError, "there is no fit whose posterior could be sampled"):
            unfitted.sample(progress=False)
        silent = self.study(STUDY.replace('noise = "0.06 N"\n', ""))
        silent.run(progress=False)
        with self.assertRaisesRegex(latsch.Failure, "state the noise"):
            silent.sample(progress=False)
        self.assertIsNone(silent.samples())
        robust = self.study(STUDY.replace('noise = "0.06 N"\n', 'noise = "0.06 N"\nloss = "huber"\n'))
        robust.run(progress=False)
        with self.assertRaisesRegex(latsch.InputError, "robust loss"):
            robust.sample(progress=False)


if __name__ == "__main__":
    unittest.main()
