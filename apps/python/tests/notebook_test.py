#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests what objects show in a notebook, tables for pandas, and the best point of an optimizer."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest
import xml.etree.ElementTree

os.environ.setdefault("LATSCH_PROGRAM", sys.argv[1] if len(sys.argv) > 1 else "latsch")

import latsch  # noqa: E402
import numpy as np  # noqa: E402
from python_testing import ROOT  # noqa: E402

try:
    import pandas
except ImportError:
    pandas = None


def read(shown):
    """Reads what a notebook would show; an error in a tag is an error of the test."""
    return xml.etree.ElementTree.fromstring(shown)


def points_of(drawing):
    return np.array([[float(one) for one in pair.split(",")] for pair in drawing.get("points").split()])


class Recordings(unittest.TestCase):
    def test_a_channel_is_drawn_over_time_from_its_least_to_its_largest_value(self):
        time = np.linspace(0, 2, 5000)
        force = np.sin(5 * time)
        force[1234] = 7.0  # one sample that a thinned curve would lose
        shown = read(latsch.Recording({"time": time, "Fz": force}, {"time": "s", "Fz": "N"})._repr_html_())
        self.assertIn("Fz [N] over time [s]", "".join(shown.itertext()))
        points = points_of(shown.find(".//polyline"))
        self.assertLess(len(points), 1000)
        self.assertAlmostEqual(points[:, 1].min(), 0.0)  # the peak is at the top
        self.assertAlmostEqual(points[np.argmin(points[:, 1]), 0], 260 * time[1234] / 2, delta=0.3)

    def test_names_notes_and_missing_numbers_break_nothing(self):
        shown = read(latsch.Recording({"a<b>&": np.array([np.nan, np.inf]), "one": np.array([3.25]), "none": np.array([])},
                                      {"a<b>&": "1", "one": "m", "none": "1"}, notes=["x < y & z"])._repr_html_())
        text = "".join(shown.itertext())
        for part in ("a<b>& [1]", "no finite number", "3.25", "x < y & z"):
            self.assertIn(part, text)

    def test_many_channels_are_counted(self):
        names = [f"c{k}" for k in range(30)]
        shown = latsch.Recording({name: np.zeros(3) for name in names}, dict.fromkeys(names, "1"))._repr_html_()
        self.assertIn("and 18 more", "".join(read(shown).itertext()))

    @unittest.skipUnless(pandas, "pandas is not installed: apt-get install python3-pandas")
    def test_channels_of_one_length_are_a_table(self):
        recording = latsch.Recording({"t": np.arange(3.0), "F": np.ones(3), "one": np.ones(1)}, {"t": "s", "F": "N", "one": "1"})
        self.assertEqual(list(recording.to_frame().columns), ["t [s]", "F [N]"])
        self.assertEqual(list(recording.to_frame(["one"])["one [1]"]), [1.0])
        with self.assertRaisesRegex(latsch.InputError, "t has 3, one has 1"):
            recording.to_frame(["t", "one"])

    @unittest.skipIf(pandas, "pandas is installed")
    def test_without_pandas_the_error_names_the_package(self):
        with self.assertRaisesRegex(latsch.InputError, "python3-pandas"):
            latsch.Recording({"t": np.arange(3.0)}, {"t": "s"}).to_frame()


class Studies(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="latsch_notebook_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copytree(ROOT / "studies/compliance", self.folder / "compliance",
                        ignore=shutil.ignore_patterns("*.latsch*", "*.html"))

    def test_a_study_shows_its_variables_before_and_its_best_trial_after_a_run(self):
        study = latsch.read_study(self.folder / "compliance/study.toml")
        before = "".join(read(study._repr_html_()).itertext())
        for variable in study.variables:
            self.assertIn(variable.name + variable.text(variable.lower), before)
        self.assertEqual(study.variables[0].text(22e6), "22 kN/mm")
        self.assertIn("no trial of a run has succeeded yet", before)
        study.run(progress=False)
        after = read(study._repr_html_())
        self.assertIn(f"best target {study.best().target:.4g}", "".join(after.itertext()))
        self.assertIsNotNone(after.find(".//polyline"))
        trials = study.trials()
        self.assertEqual(trials.names, [variable.name for variable in study.variables])
        self.assertIn(f"{np.nanmin(trials.targets):.4g}", "".join(read(trials._repr_html_()).itertext()))
        if pandas:
            frame = trials.to_frame()
            self.assertEqual(len(frame), len(trials))
            self.assertEqual(frame["target"].min(), study.best().target)


class Posteriors(unittest.TestCase):
    def test_marginals_intervals_and_chains_that_do_not_mix_are_shown(self):
        samples = np.random.default_rng(1).normal(2.0, 0.1, (500, 1))
        fields = {"points": samples, "names": ["k"], "medians": np.array([2.0]), "intervals": np.array([[1.8, 2.2]]),
                  "linear": np.array([[1.7, np.nan]]), "shapes": [None], "mixed": False, "verdict": "stands",
                  "verdict_text": "The surrogate stands.", "remarks": ["a < b"], "_columns": {"k": 0},
                  "log_densities": np.zeros(500), "chains": np.zeros(500, int)}
        shown = read(latsch.Posterior(fields)._repr_html_())
        text = "".join(shown.itertext())
        for part in ("k: 2, 95 %: 1.8 .. 2.2", "do not mix", "The surrogate stands.", "a < b"):
            self.assertIn(part, text)
        self.assertEqual(len(shown.findall(".//line")), 1)  # the linear interval has an open end
        if pandas:
            self.assertEqual(list(latsch.Posterior(fields).to_frame().columns), ["k", "log_density", "chain"])


class Optimizers(unittest.TestCase):
    def test_the_best_is_the_least_target_of_those_that_succeeded(self):
        space = latsch.DesignSpace([latsch.Variable("x", lower=-1, upper=1, initial=0.5)])
        optimizer = latsch.optimizer(space, residuals=True)
        self.assertIsNone(optimizer.best)
        seen = []
        for _ in range(6):
            point = optimizer.propose()[0]
            outcome = latsch.Failure("no") if len(seen) == 1 else latsch.Score(residuals=[point[0] - 0.1, 0.1])
            optimizer.observe(point, outcome)
            seen.append((np.inf if isinstance(outcome, latsch.Failure) else outcome.value, point[0]))
        point, score = optimizer.best
        self.assertEqual((score.value, point[0]), min(seen))


if __name__ == "__main__":
    unittest.main()
