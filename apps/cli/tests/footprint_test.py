#!/usr/bin/env python3
"""Pressures and grip of a footprint as channels.

    footprint_test.py PATH/TO/latsch
"""
import json
import unittest

from cli_testing import WRONG_INPUT, Coarse

SIDE = 10  # mm
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
    def channels(self, keys):
        test = f'{{kind = "footprint", loads = ["2 kN"], {keys}}}'
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / "tire.toml", test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def test_sensors_side_by_side_weigh_the_tire(self):
        sensors = ", ".join(f'["{x} mm", "{y} mm"]' for x, y in GRID)
        found = self.channels(f'sensor = "{SIDE} mm", sensors = [{sensors}]')
        self.assertEqual(len(found["pressure"]), len(GRID))
        self.assertAlmostEqual(sum(found["pressure"]) * (SIDE * 1e-3)**2 / found["load"][0], 1.0, delta=1e-6)
        for (x, y), at_x, at_y in zip(GRID, found["sensor_x"], found["sensor_y"], strict=True):
            self.assertAlmostEqual(at_x, x * 1e-3, delta=1e-9)
            self.assertAlmostEqual(at_y, y * 1e-3, delta=1e-9)
        peak, = found["peak_pressure"]
        self.assertGreaterEqual(peak, max(found["pressure"]) * (1 - 1e-4))  # it is looked for to a thousandth of a sensor
        self.assertGreater(peak, found["mean_pressure"][0])

    def test_a_larger_sensor_sees_a_lower_peak(self):
        peaks = [self.channels(f'sensor = "{side} mm"')["peak_pressure"][0] for side in (5, 15, 40)]
        self.assertTrue(peaks[0] >= peaks[1] > peaks[2], peaks)

    def test_more_friction_is_used_less(self):
        none, little, much = (self.channels(f"friction = {mu}")["grip_level"][0] for mu in (0, 0.05, 0.8))
        self.assertEqual(none, 0.0)
        self.assertTrue(0.0 < much < little <= 1.0, (little, much))

    def patch(self, keys, **values):
        file = self.folder / "patch.toml"
        file.write_text(STUDY.replace("KEYS", keys) + "".join(VALUE.format(*value) for value in values.items()))
        return file

    def test_slopes_of_the_patch_are_right_under_a_load_and_at_a_deflection(self):
        for keys, other in (('loads = ["2 kN"]', {"deflection": "10 mm"}), ('deflections = ["11 mm"]', {"load": "2 kN"})):
            study = self.patch(keys, length="90 mm", width="120 mm", area="80 cm^2", mean_pressure="2.5 bar", **other)
            self.assertIn("All of them agree", self.latsch("check", "--derivatives", study))
            self.assertIn("trials bring their derivatives", self.latsch("check", study))

    def test_a_peak_that_has_no_slopes_is_fitted_without(self):
        study = self.patch('loads = ["2 kN"]', peak_pressure="5 bar", deflection="10 mm")
        self.assertNotIn("bring their derivatives", self.latsch("check", study))
        self.latsch("run", study)

    def test_what_is_wrong_is_said(self):
        for keys, word in (('sensor = "0 mm"', "sensor"), ('sensors = [["1 mm"]]', "sensors")):
            said = self.latsch("test", self.folder / "tire.toml", f'{{kind = "footprint", loads = ["2 kN"], {keys}}}', code=WRONG_INPUT)
            self.assert_says(said, word)


if __name__ == "__main__":
    unittest.main()
