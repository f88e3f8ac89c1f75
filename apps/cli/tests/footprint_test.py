#!/usr/bin/env python3
"""Pressures and grip of a footprint as channels.

    footprint_test.py PATH/TO/latsch
"""
import json
import unittest

from cli_testing import WRONG_INPUT, Coarse

SIDE = 10  # mm
GRID = [(x, y) for x in range(-150, 151, SIDE) for y in range(-150, 151, SIDE)]  # mm


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
        self.assertGreaterEqual(peak, max(found["pressure"]))
        self.assertGreater(peak, found["mean_pressure"][0])

    def test_a_larger_sensor_sees_a_lower_peak(self):
        peaks = [self.channels(f'sensor = "{side} mm"')["peak_pressure"][0] for side in (5, 15, 40)]
        self.assertTrue(peaks[0] >= peaks[1] > peaks[2], peaks)

    def test_more_friction_is_used_less(self):
        none, little, much = (self.channels(f"friction = {mu}")["grip_level"][0] for mu in (0, 0.05, 0.8))
        self.assertEqual(none, 0.0)
        self.assertTrue(0.0 < much < little <= 1.0, (little, much))

    def test_what_is_wrong_is_said(self):
        for keys, word in (('sensor = "0 mm"', "sensor"), ('sensors = [["1 mm"]]', "sensors")):
            said = self.latsch("test", self.folder / "tire.toml", f'{{kind = "footprint", loads = ["2 kN"], {keys}}}', code=WRONG_INPUT)
            self.assert_says(said, word)


if __name__ == "__main__":
    unittest.main()
