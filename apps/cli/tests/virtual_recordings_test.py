#!/usr/bin/env python3
"""Tests that `latsch run` records what a study measures on a model, and that it runs a comparison of models with its fits.

   virtual_recordings_test.py PATH/TO/latsch"""
import csv
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT, edit

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"

STUDY = """
[model]
kind = "magic_formula"
file = "slick.tir"
[test.pressed]
kind = "load_deflection"
deflections = ["5 mm", "10 mm", "15 mm"]
[measurement.pressed]
file = "measured/pressed.csv"
virtual = {model = "slick_ring.toml", test = "pressed"}
[variable.stiffness]
path = "VERTICAL_STIFFNESS"
lower = "50 N/mm"
upper = "300 N/mm"
initial = "200 N/mm"
scale = "logarithmic"
[experiment.load]
kind = "values"
channel = "pressed/force"
measurement = "pressed"
exponent = 2
[run]
workers = 1
"""

DRUM = """
kind = "drum_cleat"
speed = "60 km/h"
load = "2.5 kN"
drum_diameter = "2.5 m"
run_in = "0.1 s"
duration = "0.128 s"
lead = "0.02 s"
step = "0.5 ms"
sample_step = "1 ms"
[cleat]
height = "5 mm"
length = "30 mm"
bevel = "5 mm"
"""

COMPARISON = """
channels = ["Fz"]
segment = "0.1 s"
band.whole = {edges = ["10 Hz", "100 Hz"]}
[reference]
title = "Ring"
kind = "ring_tire"
file = "slick_ring.toml"
recordings = "measured"
virtual = true
[fit.spring]
study = "study.toml"
bands = false
[test.drum]
file = "drum.toml"
[model.start]
title = "Before the fit"
kind = "magic_formula"
file = "slick.tir"
[model.spring]
title = "Fitted"
kind = "magic_formula"
file = "slick.tir"
fits = ["spring"]
[model.ring]
title = "The same ring"
kind = "ring_tire"
file = "slick_ring.toml"
"""


class VirtualRecordings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_virtual_"))
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("slick.tir", "slick_ring.toml"):
            shutil.copy(STUDIES / "kerb" / name, self.folder)
        edit(self.folder / "slick.tir", ("VERTICAL_STIFFNESS = .*", "VERTICAL_STIFFNESS = 200000"))
        for name, text in (("study.toml", STUDY), ("drum.toml", DRUM), ("comparison.toml", COMPARISON)):
            (self.folder / name).write_text(text)

    def latsch(self, *words, code=DONE):
        done = subprocess.run([LATSCH, *words], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_run_records_what_the_study_measures_on_a_model(self):
        said = self.latsch("check", "study.toml", code=WRONG_INPUT)
        self.assertIn("it has not been recorded", said)
        self.assertIn("latsch run study.toml", said)
        said = self.latsch("run", "study.toml", "--record")
        self.assertIn("Recording measurement.pressed", said)
        recorded = list(csv.DictReader((self.folder / "measured/pressed.csv").read_text().splitlines()[1:]))
        by_hand = list(csv.DictReader(self.latsch(
            "test", "slick_ring.toml", '{kind = "load_deflection", deflections = ["5 mm", "10 mm", "15 mm"]}',
            "--quiet").splitlines()))
        self.assertEqual([row["force [N]"] for row in recorded], [row["force [N]"] for row in by_hand])
        self.assertIn("Recorded already: measurement.pressed", self.latsch("run", "study.toml", "--record"))
        self.assertNotIn("Recording", self.latsch("run", "study.toml"))
        edit(self.folder / "slick_ring.toml", ('pressure = "1.2 bar"', 'pressure = "1.3 bar"'))
        self.assertIn("has changed since it was recorded", self.latsch("check", "study.toml", code=WRONG_INPUT))
        self.assertIn("Recording measurement.pressed", self.latsch("run", "study.toml"))

    def test_a_channel_that_no_test_records_is_refused_before_anything_runs(self):
        edit(self.folder / "comparison.toml", ('channels = .*', 'channels = ["Fzz"]'))
        said = self.latsch("check", "comparison.toml", code=WRONG_INPUT)
        self.assertIn('has "Fzz", which test drum does not record, did you mean "Fz"?', said)
        self.assertNotIn("Recording", self.latsch("run", "comparison.toml", code=WRONG_INPUT))

    def test_one_command_records_fits_and_compares(self):
        self.assertIn("it has not been recorded", self.latsch("compare", "comparison.toml", code=WRONG_INPUT))
        done = subprocess.run([LATSCH, "run", "comparison.toml", "--json"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, DONE, done.stdout + done.stderr)
        result = json.loads(done.stdout)["result"]
        self.assertEqual([run["name"] for run in result["runs"]], ["spring"])
        models = result["cases"][0]["models"]
        far = {name: model["distance"]["whole"] for name, model in models.items()}
        # The recording is rounded to 1 N, the forces swing by hundreds.
        self.assertLess(far["ring"], 0.01)
        # The fitted model is another one than that before the fit: it has the stiffness that the fit has found.
        self.assertNotEqual(far["spring"], far["start"])
        self.assertLess(result["runs"][0]["variables"][0]["value"], 190.0)
        said = self.latsch("check", "comparison.toml")
        for words in ("spring           study.toml, has trials", "drum.csv, up to date", "its numbers from fit spring"):
            self.assertIn(words, said)
        page = (self.folder / "comparison.html").read_text()
        for words in ("Over time", "Before the fit", "The same ring"):
            self.assertIn(words, page)
        said = self.latsch("run", "comparison.toml")
        self.assertIn("This study is finished", said)
        self.assertNotIn("Recording", said)
        edit(self.folder / "drum.toml", ('speed = "60 km/h"', 'speed = "50 km/h"'))
        self.assertIn("has changed since it was recorded", self.latsch("compare", "comparison.toml", code=WRONG_INPUT))
        self.assertIn("drum.csv, which latsch run records, because the model or the test has changed",
                      self.latsch("check", "comparison.toml"))
        self.assertIn("Recording drum of Ring", self.latsch("run", "comparison.toml"))
        edit(self.folder / "measured/drum.csv", ("\n0,", "\n1e-9,"))
        said = self.latsch("run", "comparison.toml")
        self.assertIn("its values have been changed since it was recorded", said)
        self.assertIn("the changed values stay as measured/drum.csv.changed", said)


if __name__ == "__main__":
    unittest.main()
