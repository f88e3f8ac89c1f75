#!/usr/bin/env python3
"""Implausible magnitudes and duplicates in tire files: the messages of `latsch check` and their
line numbers.

    plausibility_test.py PATH/TO/latsch
"""
import pathlib
import shutil
import subprocess
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT, Coarse, edit

TREE = pathlib.Path(__file__).resolve().parents[3]


class Magnitudes(Coarse):
    def line_of(self, file, part):
        return next(i for i, text in enumerate(file.read_text().splitlines(), 1) if part in text)

    def said(self, file, part, *parts, code=WRONG_INPUT):
        text = self.latsch("check", self.study, code=code)
        self.assert_says(text, f"{file.name}:{self.line_of(file, part)}: ", *parts)
        return text

    def test_the_study_itself_is_in_order(self):
        self.assertNotIn("warning", self.latsch("check", self.study))

    def test_bar_for_kilopascal(self):
        edit(self.study, ('pressure = "2.4 bar"', 'pressure = "240 bar"'))
        self.said(self.study, '"240 bar"', 'experiment.stiffness.pressure is "240 bar"', "0.3 to 16 bar", '"240 kPa" would be usual')
        self.assert_says(self.latsch("run", self.study, code=WRONG_INPUT), '"240 kPa" would be usual')  # before any trial
                                                                                                        # runs
        self.assertFalse((self.folder / "study.latsch").exists())

    def test_unusual_may_be_meant(self):
        edit(self.study, ('pressure = "2.4 bar"', 'pressure = "20 bar"'))
        self.said(self.study, '"20 bar"', "warning: ", "Nothing is refused, but there", code=DONE)

    def test_the_density_of_air(self):
        tire = self.folder / "tire.toml"
        edit(tire, ('density = "1150 kg/m.3"', 'density = "1.2 kg/m^3"'))
        self.said(tire, '"1.2 kg/m^3"', "rubber.tread.density", "700 to 3000 kg/m^3", '"1.2 g/cm^3" would be usual')

    def test_moduli_of_another_unit(self):
        tire = self.folder / "tire.toml"
        edit(tire, ('young_modulus = "8 MPa"', 'young_modulus = "8 GPa"'))
        self.said(tire, '"8 GPa"', "rubber.belt.young_modulus", '"8 MPa" would be usual')

    def test_kilonewtons_taken_for_newtons(self):
        forces = self.folder / "stiffness.csv"
        forces.write_text("deflection [mm], force [N]\n6, 0.9\n12, 2.1\n")
        self.said(forces, "6, 0.9", "0.15 N/mm", "too soft", 'force [kN]')
        forces.write_text("deflection [mm], force [kN]\n6, 900\n12, 2100\n")
        self.said(forces, "6, 900", "too stiff", 'force [N]')

    def test_deflections_deeper_than_the_section(self):
        forces = self.folder / "stiffness.csv"
        forces.write_text("deflection [cm], force [N]\n6, 9000\n12, 21000\n")
        self.said(forces, "12, 21000", "deflection is 120 mm", "deeper than the section", code=WRONG_INPUT)
        forces.write_text("deflection [cm], force [N]\n7, 9000\n12, 21000\n")  # the impossible value follows one that is
                                                                               # nearly plausible
        self.said(forces, "12, 21000", "deflection is 120 mm", "deeper than the section", code=WRONG_INPUT)
        forces.write_text("deflection [mm], force [N]\n70, 15000\n")
        self.said(forces, "70, 15000", "warning: ", "close to the section", code=DONE)
        edit(self.study, ('kind = "modes"', 'kind = "modes"\ndeflection = "20 cm"'))
        self.said(self.study, '"20 cm"', "experiment.modes.deflection", "deeper than the section")

    def test_a_loaded_radius_beyond_the_tire(self):
        forces = self.folder / "stiffness.csv"
        forces.write_text("loaded_radius [mm], force [N]\n620, 1000\n600, 3000\n")
        self.said(forces, "620", "loaded_radius is 620.0 mm", "a diameter?")

    def test_modes_twice_and_kilohertz(self):
        modes = self.folder / "modes.csv"
        modes.write_text("frequency [Hz], n, type\n46, 0, lateral\n46, 0, lateral\n50, 2, lateral\n50, 2, lateral\n")
        text = self.latsch("check", self.study)
        self.assert_says(text, "modes.csv:3: ", "is in the table twice", "warning")
        self.assertNotIn("modes.csv:5", text)  # a pair of modes
        modes.write_text("frequency [Hz], n, type\n" + 3 * "46, 1, lateral\n")
        self.assert_says(self.latsch("check", self.study, code=WRONG_INPUT), "modes.csv:4: ", "three times")
        modes.write_text("frequency [kHz], n, type\n46, 1, lateral\n")
        self.assert_says(self.latsch("check", self.study, code=WRONG_INPUT), "modes.csv:2: ", "8 to 1000 Hz")

    def test_one_number_in_two_variables(self):
        edit(self.study, (r"\[experiment.stiffness\]",
                          '[variable.again]\npath = "layer.carcass.young_modulus"\nlower = "1 GPa"\nupper = "9 GPa"\n'
                          'initial = "5 GPa"\n\n[experiment.stiffness]'))
        self.said(self.study, "[variable.again]", '"layer.carcass.young_modulus"', 'set by variable "carcass" already')
        edit(self.study, (r"\[variable.again\]\n(.+\n)*", ""), (r'path = "layer.carcass.young_modulus"',
                          'paths = ["layer.carcass.young_modulus", "layer.carcass.young_modulus"]'))
        self.said(self.study, "[variable.carcass]", "already: expected each number in one variable, once")

    def test_the_same_table_fitted_twice(self):
        text = self.study.read_text()
        block = text[text.index("[experiment.stiffness]"):text.index("# Modes of the tire")]
        self.study.write_text(text.replace(block, block + block.replace("experiment.stiffness", "experiment.again")))
        self.assert_says(self.latsch("check", self.study), "experiment.again.measurement", "it counts twice")

    def test_studies_that_are_shipped_are_plausible(self):
        for file in sorted((TREE / "studies").glob("*/study.toml")):
            run = subprocess.run([LATSCH, "check", file], capture_output=True, text=True)
            self.assertNotIn("warning", run.stderr, file)
            self.assertEqual(run.returncode, DONE, run.stderr)


if __name__ == "__main__":
    unittest.main()
