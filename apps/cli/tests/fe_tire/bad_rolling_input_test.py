#!/usr/bin/env python3
"""Tests that wrong conditions of a finite-element tire that rolls are told in words: what, where, why, what next. Every
row of the table is one wrong input, the exit code, and parts of the message.

   bad_rolling_input_test.py PATH/TO/latsch"""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, WRONG_INPUT, Coarse

FAILED = 1
STATE = 'load = "2 kN", speed = "60 km/h"'

# A line of the rubber "tread", tables at the end of the file, the test, the exit code, parts of the message.
WRONG = (
    # Friction, forces and speeds.
    ("", "", f'kind = "rolling", {STATE}, friction = 0, alpha = "1 deg"', WRONG_INPUT, "friction is 0", "neither torque nor side force"),
    ("", "", f'kind = "rolling", {STATE}, friction = 0, kappa = 0.01', WRONG_INPUT, "friction is 0", "expected friction above 0"),
    ("", "", f'kind = "rolling", {STATE}, friction = -0.1', WRONG_INPUT, "friction is -0.1", "expected 0 to 5"),
    ("", "", f'kind = "rolling", {STATE}, torque = "200 N m"', WRONG_INPUT, 'unknown key "test.torque"'),
    ("", "", 'kind = "rolling", load = "2 kN", speed = "340 km/h"', FAILED, "rad/s", "km/h", "standing-wave speed", "n = ", "expected a lower speed"),
    ("", "", 'kind = "rolling", load = "2 kN", speed = "208 km/h"', FAILED, "208 km/h", "standing wave", "expected a lower speed"),
    ("", "", 'kind = "rolling", load = "2 kN", speed = "0 km/h"', WRONG_INPUT, "speed is 0", "above 0", "static_stiffness"),
    ("", "", 'kind = "rolling", load = "2 kN", speed = "-60 km/h"', WRONG_INPUT, 'speed is "-60 km/h"', "expected", "km/h"),
    ("", "", f'kind = "rolling", {STATE}, kappa = -1.5', WRONG_INPUT, "kappa is -1.5", "expected -1 to 5"),
    ("", "", f'kind = "rolling", {STATE}, alpha = "100 deg"', WRONG_INPUT, "alpha", "100 deg", "80.2"),
    ("", "", f'kind = "rolling", {STATE}, camber = "40 deg"', WRONG_INPUT, "camber", "40 deg", "expected"),
    ("", "", 'kind = "rolling", load = "0 N", speed = "60 km/h"', WRONG_INPUT, "load", "0 N", "more than 0"),
    ("", "", 'kind = "rolling", load = "55 kN", speed = "60 km/h"', FAILED, "deflection", "the rim holds the tire up to"),
    # Losses.
    ('prony = [[-0.1, "1 ms"]]', "", f'kind = "rolling", {STATE}', WRONG_INPUT, "rubber.tread.prony", "[-0.1, 0.001 s]", "expected 0 or more"),
    ('prony = [[0.1, "0 ms"]]', "", f'kind = "rolling", {STATE}', WRONG_INPUT, "rubber.tread.prony", "[0.1, 0 s]", "expected one above 0"),
    ('prony = [[60, "1 ms"]]', "", f'kind = "rolling", {STATE}', WRONG_INPUT, "rubber.tread.prony", "60", "at most 50"),
    ('prony = [[0.1, "1 ms"], [0.2, "1 ms"]]', "", f'kind = "rolling", {STATE}', WRONG_INPUT, "rubber.tread.prony", "same relaxation time", "one term"),
    ("loss_factor = 1.5", "", f'kind = "rolling", {STATE}', WRONG_INPUT, "rubber.tread.loss_factor is 1.5", "expected 0 to 1"),
    ("", "", f'kind = "rolling", {STATE}', DONE, "rolling_resistance is that of friction alone"),
    # Places, grounds, cleats.
    ("", "", f'kind = "rolling_chain", {STATE}, position = 1.2', WRONG_INPUT, "position is 1.2", "expected -1 to 1"),
    ("", "", f'kind = "rolling_chain", {STATE}, depth = "belt"', FAILED, 'depth "belt"', "expected inner, outer or", "belt_1"),
    ("", "", f'kind = "rolling", {STATE}, drum_radius = "0.05 m"', WRONG_INPUT, "drum_radius", "0.05 m", "expected 0.1 m to 100 m"),
    ("", "", f'kind = "rolling", {STATE}, drum_radius = "0.8 m", turn_slip = "0.1 1/m"', WRONG_INPUT, "turn slip", "drum", "expected flat ground"),
    ("", "", 'kind = "load_deflection", deflections = ["200 mm"]', FAILED, "deflection", "the rim holds the tire up to"),
    ("", "", 'kind = "static_stiffness", deflections = ["10 mm"], cleat = {height = "200 mm", length = "20 mm"}', WRONG_INPUT,
     "cleat.height is 200 mm", "the section of this tire is", "expected a lower one"),
    # The mesh.
    ("", "", f'kind = "rolling", {STATE}, alpha = "1 deg"', DONE, "sectors at the ground are", "narrow the sectors"),
    ("", "", 'kind = "modes", count = 60', DONE, "waves around are not exact", "18 sectors", "expected finer sectors"),
    # The rim.
    ("", '[rim]\nmass = "0 kg"\ninertia_spin = "0.2 kg m^2"\ninertia_diameter = "0.15 kg m^2"', 'kind = "modes", rim = "free"', WRONG_INPUT,
     'rim.mass is "0 kg"', "more than 0 kg"),
    ("", '[rim]\nmass = "8 kg"\ninertia_spin = "0.9 kg m^2"\ninertia_diameter = "0.15 kg m^2"', 'kind = "modes", rim = "free"', WRONG_INPUT,
     "rim.inertia_spin", "0.9", "expected at most 0.3"),
    ("", "", 'kind = "modes", rim = "free"', WRONG_INPUT, "expected a table [rim]"),
)


class BadRollingInput(Coarse):
    def test_every_wrong_input_is_told_in_words(self):
        text = (self.folder / "tire.toml").read_text()
        for line, tables, keys, code, *parts in WRONG:
            with self.subTest(f"{line} {tables} {keys}"):
                tire = self.folder / "wrong.toml"
                tire.write_text(text.replace("[rubber.tread]\n", f"[rubber.tread]\n{line}\n", 1) + f"\n{tables}\n")
                said = self.latsch("test", tire, "{%s}" % keys, code=code)
                for part in parts:
                    self.assertIn(part, said)

    def test_a_drum_around_which_the_patch_reaches_is_refused(self):
        fine = self.folder / "fine.toml"
        fine.write_text((self.folder / "tire.toml").read_text().replace("sectors = 18", "sectors = 60"))
        said = self.latsch("test", fine, '{kind = "rolling", load = "12 kN", speed = "60 km/h", drum_radius = "0.1 m"}', code=FAILED)
        for part in ("state 1 of 1", "the drum's radius is 100 mm", "the patch reaches", "expected a larger one"):
            self.assertIn(part, said)

    def test_a_mesh_without_like_sectors_does_not_roll(self):
        deck, smeared = self.folder / "tire.inp", self.folder / "smeared.toml"
        smeared.write_text((self.folder / "tire.toml").read_text().replace('cords = "rebar"', 'cords = "smeared"'))
        self.latsch("export", smeared, "--ccx", deck)
        lines = deck.read_text().split("\n")
        first = next(k for k, line in enumerate(lines) if line.upper().startswith("*NODE"))
        fields = max((line.split(",") for line in lines[first + 1:first + 400]), key=lambda node: abs(float(node[1])))
        at = lines.index(",".join(fields))
        fields[1] = str(1.002 * float(fields[1]))
        lines[at] = ",".join(fields)
        deck.write_text("\n".join(lines))
        for keys in (f'kind = "rolling", {STATE}, pressure = "2.4 bar"', 'kind = "modes", speed = "60 km/h", pressure = "2.4 bar"'):
            with self.subTest(keys):
                said = self.latsch("test", deck, "{%s}" % keys, code=FAILED)
                for part in ("a mesh without equal sectors", "expected a tire of equal sectors"):
                    self.assertIn(part, said)


if __name__ == "__main__":
    unittest.main()
