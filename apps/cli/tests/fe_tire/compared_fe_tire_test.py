#!/usr/bin/env python3
"""Tests that `latsch compare` takes a finite-element tire as the specimen of faster tires: it crosses the cleat as
`latsch test` takes it, in its own step, and the comparison states what it assumed, what it cost, and how the faster
tire does on the cleats to which it was not fitted.

   compared_fe_tire_test.py PATH/TO/latsch"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, edit

STUDY = pathlib.Path(__file__).resolve().parents[4] / "studies" / "fe_ring_tire"
RING = STUDY.parent / "ring_tires" / "passenger_205_55R16.toml"
TEST = """\
kind = "drum_cleat"
speed = "60 km/h"
load = "3 kN"
drum_diameter = "2.5 m"
run_in = "0.05 s"
duration = "0.04 s"
lead = "0.015 s"
step = "0.5 ms"
sample_step = "1 ms"
[cleat]
height = "HEIGHT mm"
length = "40 mm"
bevel = "3 mm"
angle = "20 deg"
"""
COMPARISON = f"""\
channels = ["Fx", "Fy", "Fz", "Mx"]
band = ["30 Hz", "300 Hz"]
[specimen]
kind = "fe_tire"
file = "tire.toml"
step = "1 ms"
[tire.ring]
title = "Ring"
kind = "ring_tire"
file = "{RING}"
[test.low]
file = "low.toml"
fitted = true
[test.high]
file = "high.toml"
"""
CHANNELS = ("Fx", "Fy", "Fz", "Mx")


class AFiniteElementTireIsTheSpecimen(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_compared_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        tire = cls.folder / "tire.toml"
        shutil.copy(STUDY / "tire.toml", tire)
        edit(tire, ("meridional = .*", "meridional = 13"), ("sectors = .*", "sectors = 36"),
             ("sector_zones = .*", 'sector_zones = [[6, "2.4 deg"], [2, "4 deg"]]'))
        for name, height in (("low", 4), ("high", 6)):
            (cls.folder / f"{name}.toml").write_text(TEST.replace("HEIGHT", str(height)))
        (cls.folder / "comparison.toml").write_text(COMPARISON)
        cls.compared = cls.latsch("compare", "comparison.toml", "--json")
        cls.result = json.loads(cls.compared)["result"]

    @classmethod
    def latsch(cls, *arguments):
        run = subprocess.run([LATSCH, *arguments], cwd=cls.folder, capture_output=True, text=True)
        if run.returncode != DONE:
            raise AssertionError(f"latsch {' '.join(arguments)}\n{run.stdout}{run.stderr}")
        return run.stdout

    def table(self, name):
        rows = list(csv.reader((self.folder / name).read_text().splitlines()))
        heads = [head.split(" ")[0] for head in rows[0]]
        return {head: [float(row[i]) for row in rows[1:]] for i, head in enumerate(heads)}

    def test_it_crosses_the_cleat_as_the_test_takes_it_in_its_own_step(self):
        self.latsch("compare", "comparison.toml", "--write-measurements", "measured")
        (self.folder / "alone.toml").write_text((self.folder / "low.toml").read_text().replace('"0.5 ms"', '"1 ms"'))
        self.latsch("test", "tire.toml", "alone.toml", "--output", "alone.csv")
        written, alone = self.table("measured/low.csv"), self.table("alone.csv")
        self.assertEqual(len(written["time"]), 40)
        for channel in CHANNELS:  # written to a tenth
            for one, other in zip(written[channel], alone[channel]):
                self.assertLess(abs(one - other), 0.0501, channel)
        self.assertGreater(max(written["Fz"]) - min(written["Fz"]), 200.0)  # the cleat is felt
        # The ring takes the step of the test, and the specimen does not.
        self.latsch("test", "tire.toml", "low.toml", "--output", "halved.csv")
        halved = self.table("halved.csv")["Fz"]
        self.assertGreater(max(abs(one - other) for one, other in zip(written["Fz"], halved)), 0.2)

    def test_what_it_assumes_is_said_with_the_tests(self):
        warnings = " ".join(map(str, json.loads(self.compared)["warnings"]))
        self.assertIn("the specimen: the tread feels the cleat through means", warnings)
        self.assertIn("(low, high)", warnings)
        self.assertIn("The specimen takes", (self.folder / "comparison.html").read_text())

    def test_its_cost_is_beside_that_of_the_faster_tire(self):
        ring = self.result["tires"][0]
        self.assertGreater(self.result["specimen"]["cpu_over_time"], 5.0 * ring["cpu_over_time"])

    def test_errors_are_told_by_test_and_over_those_held_out(self):
        ring = self.result["tires"][0]
        low, high = ring["tests"]
        self.assertEqual((low["name"], low["fitted"], high["name"], high["fitted"]), ("low", True, "high", False))
        self.assertEqual(ring["held_out"]["psd_error"], high["psd_error"])
        self.assertNotEqual(low["psd_error"], high["psd_error"])
        for i, _ in enumerate(CHANNELS):
            self.assertAlmostEqual(ring["psd_error"][i], 0.5 * (low["psd_error"][i] + high["psd_error"][i]))
        self.assertIn("In 1 held-out test Fx is off by", self.result["verdicts"][0])

    def test_a_finite_element_tire_that_is_compared_with_itself_has_no_error(self):
        text = COMPARISON[:COMPARISON.index("[test.high]")].replace('step = "1 ms"\n', "")
        text = text.replace('kind = "ring_tire"', 'kind = "fe_tire"').replace(str(RING), "tire.toml")
        (self.folder / "itself.toml").write_text(text)
        same = json.loads(self.latsch("compare", "itself.toml", "--json"))["result"]
        tire = same["tires"][0]
        self.assertEqual(tire["psd_error"], [0.0] * len(CHANNELS))
        self.assertNotIn("held_out", tire)  # every test is called fitted


if __name__ == "__main__":
    unittest.main()
