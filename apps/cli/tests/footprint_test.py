#!/usr/bin/env python3
"""Tests the channels of pressure and grip in a footprint.

   footprint_test.py PATH/TO/latsch"""
import json
import pathlib
import unittest

from cli_testing import WRONG_INPUT, Coarse

SIDE = 10  # mm
OWN_MESH = 'elements = ["1 m", "1 m"]'
GRID = [(x, y) for x in range(-150, 151, SIDE) for y in range(-150, 151, SIDE)]  # mm

STUDY = """title = "a patch"
model = "tire.toml"
test.print = {kind = "footprint", KEYS}
[variable.belt]
paths = ["layer.belt_1.young_modulus", "layer.belt_2.young_modulus"]
lower = "10 GPa"
upper = "1000 GPa"
initial = "150 GPa"
scale = "logarithmic"
[variable.pressure]
path = "pressure"
lower = "1.5 bar"
upper = "4 bar"
initial = "2.8 bar"
[optimizer]
method = "auto"
max_steps = 3
[run]
workers = 1
intervals = false
"""
VALUE = """[experiment.{0}]
kind = "values"
channel = "print/{0}"
value = "{1}"
scale = "{1}"
exponent = 2
"""


class Footprint(Coarse):
    def channels(self, keys, at='loads = ["2 kN"]'):
        test = f'{{kind = "footprint", {at}, {keys}}}'
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / "tire.toml", test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def test_sensors_side_by_side_weigh_the_tire(self):
        sensors = ", ".join(f'["{x} mm", "{y} mm"]' for x, y in GRID)
        found = self.channels(f'sensor = "{SIDE} mm", sensors = [{sensors}], {OWN_MESH}')
        self.assertEqual(len(found["pressure"]), len(GRID))
        self.assertAlmostEqual(sum(found["pressure"]) * (SIDE * 1e-3)**2 / found["load"][0], 1.0, delta=1e-6)
        for (x, y), at_x, at_y in zip(GRID, found["sensor_x"], found["sensor_y"], strict=True):
            self.assertAlmostEqual(at_x, x * 1e-3, delta=1e-9)
            self.assertAlmostEqual(at_y, y * 1e-3, delta=1e-9)
        peak, = found["peak_pressure"]
        # the peak is located to a thousandth of a sensor's size
        self.assertGreaterEqual(peak, max(found["pressure"]) * (1 - 1e-4))
        self.assertGreater(peak, found["mean_pressure"][0])

    def test_a_larger_sensor_sees_a_lower_peak(self):
        peaks = [self.channels(f'sensor = "{side} mm", {OWN_MESH}')["peak_pressure"][0] for side in (5, 15, 40)]
        self.assertTrue(peaks[0] >= peaks[1] > peaks[2], peaks)

    def test_more_friction_is_used_less(self):
        none, little, much = (self.channels(f"friction = {mu}, {OWN_MESH}")["grip_level"][0] for mu in (0, 0.05, 0.8))
        self.assertEqual(none, 0.0)
        self.assertTrue(0.0 < much < little <= 1.0, (little, much))

    def test_short_elements_are_the_footprint_s_alone(self):
        pressed = '{kind = "load_deflection", deflections = ["10 mm"]}'
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / "tire.toml", pressed, "--json"))
        force, length = (channel["values"][0] for channel in answer["result"]["channels"] if channel["name"] in ("force", "patch_length"))
        own, short, shortest = (self.channels(f"elements = {elements}", 'deflections = ["10 mm"]')
                                for elements in (["1 m", "1 m"], ["10 mm", "12 mm"], ["5 mm", "12 mm"]))
        self.assertAlmostEqual(own["load"][0] / force, 1.0, delta=1e-6)
        self.assertAlmostEqual(own["length"][0] / length, 1.0, delta=1e-6)
        for name in ("load", "length", "area"):
            off = [abs(one[name][0] / shortest[name][0] - 1) for one in (own, short)]
            self.assertLess(off[1], 0.03, name)
            self.assertLess(off[1], off[0], name)

    def patch(self, keys, **values):
        file = self.folder / "patch.toml"
        file.write_text(STUDY.replace("KEYS", keys) + "".join(VALUE.format(*value) for value in values.items()))
        return file

    def test_slopes_of_the_patch_are_right_under_a_load_and_at_a_deflection(self):
        for keys, other in ((f'loads = ["2 kN"], {OWN_MESH}', {"deflection": "10 mm"}),
                            ('deflections = ["11 mm"], elements = ["40 mm", "20 mm"]', {"load": "2 kN"})):
            study = self.patch(keys, length="90 mm", width="120 mm", area="80 cm^2", mean_pressure="2.5 bar", **other)
            self.assertIn("All of them agree", self.latsch("check", "--derivatives", study))
            self.assertIn("trials bring their derivatives", self.latsch("check", study))

    def test_a_peak_that_has_no_slopes_is_fitted_without(self):
        study = self.patch(f'loads = ["2 kN"], {OWN_MESH}', peak_pressure="5 bar", deflection="10 mm")
        self.assertNotIn("bring their derivatives", self.latsch("check", study))
        self.latsch("run", study)

    def test_what_is_wrong_is_said(self):
        for keys, word in (('sensor = "0 mm"', "sensor"), ('sensors = [["1 mm"]]', "sensors"),
                           ('elements = ["7 mm"]', "two lengths"), ('elements = ["7 mm", "0.1 mm"]', "elements")):
            said = self.latsch("test", self.folder / "tire.toml", f'{{kind = "footprint", loads = ["2 kN"], {keys}}}', code=WRONG_INPUT)
            self.assert_says(said, word)
        ring = pathlib.Path(__file__).resolve().parents[3] / "studies" / "ring_tires" / "passenger_205_55R16.toml"
        said = self.latsch("test", ring, f'{{kind = "footprint", loads = ["2 kN"], {OWN_MESH}}}', code=WRONG_INPUT)
        self.assert_says(said, "has a section to divide into elements")


if __name__ == "__main__":
    unittest.main()
