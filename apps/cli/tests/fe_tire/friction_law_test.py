#!/usr/bin/env python3
"""Tests the table [friction] of a finite-element tire: as variables of a study, in notes and in messages.

   friction_law_test.py PATH/TO/latsch"""
import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import WRONG_INPUT, Coarse

LOCKED = '{kind = "steady_states", states = "%s"}'
LAW = 'static = 0.8\npeak = 1.2\npeak_speed = "1.5 m/s"\n'


class FrictionLaw(Coarse):
    def tire_with(self, table):
        text = (self.folder / "tire.toml").read_text()
        (self.folder / "grips.toml").write_text(text + "\n[friction]\n" + table)
        return self.folder / "grips.toml"

    def locked(self):
        # A locked wheel slides with its speed: at 5.4 km/h with the peak's, at 90 km/h far beyond it.
        (self.folder / "locked_states.csv").write_text("Fz [kN],kappa,Vx [km/h]\n2,-1,5.4\n2,-1,90\n")
        return self.folder / "locked_states.csv"

    def test_a_locked_wheel_slides_with_the_friction_of_its_speed(self):
        answer, _ = json.JSONDecoder().raw_decode(
            self.latsch("test", self.tire_with(LAW), LOCKED % self.locked(), "--json"))
        Fx = {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}["Fx"]
        far = 0.8 + 0.4 * math.exp(-math.log(25 / 1.5) ** 2)
        self.assertAlmostEqual(Fx[0], -1.2 * 2000, delta=0.1)
        self.assertAlmostEqual(Fx[1], -far * 2000, delta=0.1)

    def test_a_study_finds_the_numbers_of_the_law(self):
        self.tire_with(LAW)
        self.locked()
        far = 0.7 + 0.65 * math.exp(-math.log(25 / 1.5) ** 2)
        (self.folder / "locked.csv").write_text(f"Fx [N]\n{-1.35 * 2000}\n{-far * 2000}\n")
        (self.folder / "study.toml").write_text("""
model = "grips.toml"
[test.locked]
kind = "steady_states"
states = "locked_states.csv"
[variable.static]
path = "friction.static"
lower = 0.5
upper = 1.1
initial = 0.8
[variable.peak]
path = "friction.peak"
lower = 1.1
upper = 1.6
initial = 1.2
[experiment.braking]
kind = "curve"
y = "locked/Fx"
measurement = "locked.csv"
exponent = 2
""")
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("run", self.folder / "study.toml", "--json"))
        found = {one["name"]: one["value"] for one in answer["result"]["variables"]}
        self.assertAlmostEqual(found["static"], 0.7, delta=2e-3)
        self.assertAlmostEqual(found["peak"], 1.35, delta=2e-3)

    def test_what_stands_says_that_it_has_the_friction_of_its_test(self):
        tire = self.tire_with(LAW)
        for keys, part in (('{kind = "load_deflection", deflections = ["5 mm"]}', "ground without friction"),
                           ('{kind = "load_deflection", deflections = ["5 mm"], friction = 0.5}', "friction 0.5 of the test"),
                           ('{kind = "static_stiffness", load = "1 kN", directions = ["vertical"]}', "ground without friction"),
                           ('{kind = "modes", count = 2, deflection = "5 mm"}', "ground without friction"),
                           ('{kind = "footprint", loads = ["1 kN"], elements = ["1 m", "1 m"]}', "ground without friction")):
            with self.subTest(keys):
                self.assertIn(part, self.latsch("test", tire, keys))
        self.assertNotIn("ground without friction",
                         self.latsch("test", self.folder / "tire.toml", '{kind = "load_deflection", deflections = ["5 mm"]}'))

    def test_a_fall_too_steep_for_a_steady_state_is_said(self):
        steep = self.tire_with('static = 0.8\npeak = 1.2\npeak_speed = "0.01 m/s"\npeak_width = 0.4\n')
        said = self.latsch("test", steep, LOCKED % self.locked())
        for part in ("friction 0.8 at rest and 1.2 at a sliding speed of 0.01 m/s", "above the law of the file"):
            self.assertIn(part, said)

    def test_wrong_numbers_name_key_value_and_range(self):
        for table, *parts in (("peak = 1.2\n", "friction.static"),
                              ("static = 9\n", "friction.static", "9", "0.01 to 5"),
                              ("static = 0.9\npeak = 0.5\npeak_speed = \"1 m/s\"\n", "friction.peak", "0.5", "static = 0.9"),
                              ("static = 0.9\nspeed = 3\n", "friction.speed", "unknown key")):
            with self.subTest(table):
                said = self.latsch("test", self.tire_with(table), LOCKED % self.locked(), code=WRONG_INPUT)
                for part in parts:
                    self.assertIn(part, said)


if __name__ == "__main__":
    unittest.main()
