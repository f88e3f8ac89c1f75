#!/usr/bin/env python3
"""Tests the channels of the dimensions of an inflated tire, and moduli identified from them.

   inflation_test.py PATH/TO/latsch"""
import json
import re
import unittest

from cli_testing import WRONG_INPUT, Coarse

STUDY = """title = "dimensions under pressures"
model = "tire.toml"
test.air = {kind = "inflation", pressures = ["1 bar", "2 bar", "3 bar"]}
test.rim = {kind = "inflation"}
test.ground = {kind = "load_deflection", pressure = "2 bar", deflections = ["10 mm"]}
[variable.belt]
paths = ["layer.belt_1.young_modulus", "layer.belt_2.young_modulus"]
lower = "10 GPa"
upper = "1000 GPa"
initial = "INITIAL"
scale = "logarithmic"
[variable.pressure]
path = "pressure"
lower = "1.5 bar"
upper = "4 bar"
initial = "3 bar"
[experiment.growth]
kind = "curve"
x = "air/pressure"
y = "air/growth"
measurement = "inflated.csv"
exponent = 2
[experiment.width]
kind = "values"
channel = "rim/section_width"
value = "WIDTH mm"
exponent = 2
[experiment.force]
kind = "values"
channel = "ground/force"
value = "FORCE N"
weight = 0
exponent = 2
[optimizer]
method = "auto"
[run]
workers = 1
"""


class Inflation(Coarse):
    def channels(self, test):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / "tire.toml", test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def measured(self, initial):
        """Writes a measurement simulated with the tire's own numbers."""
        recorded = self.channels('{kind = "inflation", pressures = ["1 bar", "2 bar", "3 bar"]}')
        rows = zip(recorded["pressure"], recorded["growth"], strict=True)
        (self.folder / "inflated.csv").write_text("pressure [bar],growth [mm]\n" +
                                                  "".join(f"{p / 1e5:.6g},{g * 1e3:.9g}\n" for p, g in rows))
        width = self.channels('{kind = "inflation"}')["section_width"][0] * 1e3
        force = self.channels('{kind = "load_deflection", pressure = "2 bar", deflections = ["10 mm"]}')["force"][0]
        file = self.folder / "inflation.toml"
        file.write_text(STUDY.replace("INITIAL", initial).replace("WIDTH", f"{width:.9f}").replace("FORCE", f"{force:.9g}"))
        return file

    def own(self, key):
        return re.search(rf'{key} = "([\d.]+) ', (self.folder / "tire.toml").read_text())[1]

    def test_a_tire_grows_as_its_radius_does(self):
        found = self.channels('{kind = "inflation", pressures = ["0.001 bar", "1 bar", "3 bar"]}')
        self.assertEqual(found["pressure"], [100.0, 1e5, 3e5])
        growth, radius = found["growth"], found["outer_radius"]
        self.assertTrue(0 < growth[0] < 1e-5 < growth[1] < growth[2] < 0.02, growth)
        # Both channels refer to the same node, or to different nodes on a nearly flat crown.
        self.assertAlmostEqual(radius[2] - radius[0], growth[2] - growth[0], delta=0.3 * growth[2])
        self.assertTrue(0.15 < found["section_width"][2] < 0.4)

    def test_unless_stated_the_pressure_is_the_tires_own(self):
        own = self.own("pressure")
        self.assertEqual(self.channels('{kind = "inflation"}'), self.channels(f'{{kind = "inflation", pressures = ["{own} bar"]}}'))

    def test_slopes_are_right_also_in_a_pressure_that_a_test_does_not_use(self):
        """Checks that growth and force at stated pressures do not depend on the tire's own pressure."""
        said = self.latsch("check", "--derivatives", self.measured("100 GPa"))
        self.assertIn("All of them agree", said)

    def test_belt_and_pressure_are_found(self):
        study = self.measured("60 GPa")
        said = self.latsch("run", study)
        self.latsch("export", study, "--model", self.folder / "found.toml")
        true, found = ((self.folder / name).read_text() for name in ("tire.toml", "found.toml"))
        for key, unit in ((r"\npressure", "bar"), (r"\[layer.belt_1\][^\[]*young_modulus", "GPa")):
            number = lambda text: float(re.search(rf'{key} = "(\S+) (\S+)"', text)[1])
            self.assertAlmostEqual(number(found) / number(true), 1.0, delta=2e-3, msg=said)

    def test_what_is_wrong_is_said(self):
        tire = self.folder / "tire.toml"
        self.assert_says(self.latsch("test", tire, '{kind = "inflation", pressures = ["-1 bar"]}', code=WRONG_INPUT), "pressures")
        self.assert_says(self.latsch("test", tire, '{kind = "inflation", pressure = "1 bar"}', code=WRONG_INPUT), "pressures")


if __name__ == "__main__":
    unittest.main()
