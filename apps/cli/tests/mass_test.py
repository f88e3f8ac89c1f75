#!/usr/bin/env python3
"""Tests mass and moments of inertia of a finite-element tire, and densities identified from them.

   mass_test.py PATH/TO/latsch"""
import json
import re
import unittest

from cli_testing import WRONG_INPUT, Coarse, edit

TEST = '{kind = "mass_properties"}'
CHANNELS = ("mass", "spin_inertia", "diametral_inertia")
REGIONS = ("belt", "upper_sidewall", "lower_sidewall")
STUDY = """title = "distribution of mass"
model = "tire.toml"
test.scale = {kind = "mass_properties"}
test.air = {kind = "modes", count = 6}
"""
VARIABLE = """[variable.{0}]
path = "rubber.{0}.density"
lower = "900 kg/m^3"
upper = "1500 kg/m^3"
initial = "1000 kg/m^3"
"""
EXPERIMENT = """[experiment.{0}]
kind = "values"
channel = "scale/{0}"
value = "{1} {2}"
exponent = 2
"""
MODES = """[experiment.modes]
kind = "values"
channel = "air/frequency"
values = {{unit = "Hz", values = [{}]}}
exponent = 2
"""
END = """[optimizer]
method = "auto"
[run]
workers = 1
"""


class Mass(Coarse):
    def channels(self, model, test=TEST):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", model, test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def densities(self, file):
        text = file.read_text()
        return {region: float(re.search(rf'\[rubber.{region}\][^\[]*density = "(\S+) ', text)[1]) for region in REGIONS}

    def test_a_mass_is_what_the_mesh_says_and_moments_are_between_those_of_crown_and_rim(self):
        tire = self.folder / "tire.toml"
        found = self.channels(tire)
        mass, = found["mass"]
        said = float(re.search(r"mass\D*([\d.]+) kg", self.latsch("mesh", tire))[1])
        self.assertAlmostEqual(mass, said, delta=0.006)
        spin, = found["spin_inertia"]
        self.assertTrue(0.2 < (spin / mass)**0.5 < 0.32, spin)
        self.assertTrue(0.5 < found["diametral_inertia"][0] / spin < 0.7)

    def test_an_inp_weighs_what_the_tire_does_that_it_was_written_from(self):
        tire, deck = self.folder / "tire.toml", self.folder / "tire.inp"
        edit(tire, ('cords = "rebar"', 'cords = "smeared"\nelement = "full_integration"'))
        self.latsch("export", tire, "--ccx", deck, "--deflection", "12 mm", "--modes", "6")
        for theirs, ours in zip(self.channels(deck).values(), self.channels(tire).values(), strict=True):
            self.assertAlmostEqual(theirs[0] / ours[0], 1.0, delta=1e-5)

    def test_densities_of_regions_are_found_by_slopes(self):
        """Checks that the mass and two moments of inertia determine three densities, and that frequencies determine
        them, too."""
        tire, study = self.folder / "tire.toml", self.folder / "mass.toml"
        weighed, units = self.channels(tire), ("kg", "kg m^2", "kg m^2")
        study.write_text(STUDY + "".join(VARIABLE.format(region) for region in REGIONS) +
                         "".join(EXPERIMENT.format(name, weighed[name][0], unit) for name, unit in zip(CHANNELS, units)) +
                         MODES.format(", ".join(map(str, self.channels(tire, '{kind = "modes", count = 6}')["frequency"]))) +
                         END)
        self.assertIn("All of them agree", self.latsch("check", "--derivatives", study))
        said = self.latsch("run", study)
        self.latsch("export", study, "--model", self.folder / "found.toml")
        found, true = self.densities(self.folder / "found.toml"), self.densities(tire)
        for region in REGIONS:
            self.assertAlmostEqual(found[region] / true[region], 1.0, delta=1e-3, msg=said)

    def test_a_tire_that_is_a_formula_is_not_weighed(self):
        ring = self.folder / "ring"
        self.latsch("new", ring, "--ring-data")
        model = next(ring.glob("*.toml")) if not (ring / "ring.toml").exists() else ring / "ring.toml"
        self.assert_says(self.latsch("test", model, TEST, code=WRONG_INPUT), "is a finite-element tire")


if __name__ == "__main__":
    unittest.main()
