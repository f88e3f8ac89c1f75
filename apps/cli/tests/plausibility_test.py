#!/usr/bin/env python3
"""Tests the messages of `latsch check` about implausible magnitudes and duplicates in tire files, and their line
numbers.

   plausibility_test.py PATH/TO/latsch"""
import pathlib
import shutil
import subprocess
import tempfile
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

    def test_a_cleat_that_the_mesh_does_not_resolve_is_told(self):
        stiffness = '{kind = "static_stiffness", deflections = ["8 mm"], cleat = {height = "10 mm", length = "%s"}}'
        self.assertIn("rows of nodes of this tire's mesh are", self.latsch("test", self.folder / "tire.toml", stiffness % "20 mm"))
        self.assertNotIn("rows of nodes", self.latsch("test", self.folder / "tire.toml", stiffness % "400 mm"))

    def test_a_patch_that_slides_within_the_travel_is_told(self):
        ring = TREE / "studies" / "ring_tires" / "passenger_205_55R16.toml"
        lateral = '{kind = "static_stiffness", load = "3 kN", directions = ["lateral"], travel = "%s"}'
        self.assertIn("most of the patch slides", self.latsch("test", ring, lateral % "40 mm"))
        self.assertNotIn("slides", self.latsch("test", ring, lateral % "1 mm"))

    def test_bar_for_kilopascal(self):
        edit(self.study, ('pressure = "2.4 bar"', 'pressure = "240 bar"'))
        self.said(self.study, '"240 bar"', 'experiment.stiffness.pressure is "240 bar"', "0.3 to 16 bar", '"240 kPa" would be usual')
        # the message comes before any trial runs
        self.assert_says(self.latsch("run", self.study, code=WRONG_INPUT), '"240 kPa" would be usual')
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
        # The impossible value follows one that is almost plausible.
        forces.write_text("deflection [cm], force [N]\n7, 9000\n12, 21000\n")
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
        self.assertNotIn("modes.csv:5", text)  # its two equal frequencies are a pair of modes
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


class ModelsAlone(unittest.TestCase):
    """Checks that model files without a study get the same messages as in a study."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_plausible_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.number = 0

    def changed(self, file, *replacements):
        self.number += 1
        copy = self.folder / f"{self.number}{file.suffix}"
        shutil.copy(file, copy)
        edit(copy, *replacements)
        return copy

    def run_it(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    RING = TREE / "studies/ring_tires/passenger_205_55R16.toml"
    FE = TREE / "studies/tires/passenger_205_55R16.toml"
    TIR = TREE / "studies/tire_model_comparison/rigid_ring.tir"
    PRESSED = '{kind = "load_deflection", deflections = ["20 mm"]}'

    def test_a_ring_with_numbers_that_no_tire_has(self):
        for pattern, new, says in (
                ('pressure = "2.4 bar"', 'pressure = "240 bar"', '"240 kPa" would be usual'),
                ('mass = "4.52276 kg"', 'mass = "4.52276 g"', '"4.52276 kg" would be usual'),
                ('mass = "4.52276 kg"', 'mass = "4522.76 kg"', "a belt's mass on its surface is usually 1 to 300 kg/m^2"),
                ('height = "11 mm"', 'height = "11 m"', '"11 mm" would be usual'),
                ('height = "11 mm"', 'height = "0.011 mm"', '"0.011 m" would be usual'),
                ('width = "160 mm"', 'width = "16 m"', "15 to 1500 mm"),
                ("shear_ratio = 0.3333", "shear_ratio = 33.33", "a ratio of moduli is usually 0.1 to 1.5"),
                ('radius = "305 mm"', 'radius = "305 m"', '"305 mm" would be usual'),
                ('extension = "2 MN"', 'extension = "2 N"', '"2 MN" would be usual'),
                ('stiffness = "0.55 MN/m.2"', 'stiffness = "550 N/m^2"', '"550 kN/m^2" would be usual'),
                ('damping = "90 N s/m.2"', 'damping = "90 MN s/m^2"', "a sidewall's damping"),  # a sibling
                ('time_constant = "15.4 ms"', 'time_constant = "15.4 s"', '"15.4 ms" would be usual'),
                ('progressive_travel = "40 mm"', 'progressive_travel = "40 m"', '"40 mm" would be usual'),
                ('torsion = "5 kN/rad"', 'torsion = "5000 MN/rad"', "a sidewall's torsion")):
            with self.subTest(new=new):
                ring = self.changed(self.RING, (pattern, new))
                for arguments in (("check", ring), ("test", ring, self.PRESSED)):
                    self.assertIn(says, self.run_it(*arguments, code=WRONG_INPUT))
        self.assertNotIn("usual", self.run_it("check", self.RING))
        for pressure in ("20 bar", "2.4 kPa", "0 bar"):  # unusual values, which may be intended
            unusual = self.changed(self.RING, ('pressure = "2.4 bar"', f'pressure = "{pressure}"'))
            self.assertIn("warning: ", self.run_it("check", unusual))
            self.assertIn("warning: ", self.run_it("test", unusual, self.PRESSED))
        for pattern, new, says in (('bending_in_plane = "1.8 N m.2"', 'bending_in_plane = "1.8 kN m^2"', "0.001 to 300 N m^2"),
                                   ('damping_time = "0.1 ms"', 'damping_time = "0.1 s"', '"0.1 ms" would be usual')):
            self.assertIn(says, self.run_it("check", self.changed(self.RING, (pattern, new))))

    def test_a_finite_element_tire_with_numbers_that_no_tire_has(self):
        for pattern, new, says in (
                ('pressure = "2.4 bar"', 'pressure = "240 bar"', '"240 kPa" would be usual'),
                ('density = "1150 kg/m.3"', 'density = "1150 g/cm^3"', '"1150 kg/m^3" would be usual'),
                ('spacing = "1.0 mm"', 'spacing = "1.0 m"', '"1.0 mm" would be usual'),
                ('spacing = "1.25 mm"', 'spacing = "0.01 mm"', "0.3 to 5 mm"),
                ('cord_area = "0.246 mm.2"', 'cord_area = "0.246 cm^2"', "the cords overlap"),
                ('cord_diameter = "0.55 mm"', 'cord_diameter = "5.5 mm"', "the cords overlap"),
                ('cord_diameter = "0.55 mm"', 'cord_diameter = "1.5 mm"', "cord_diameter makes a cord of 1.5 mm"),
                ('spacing = "1.0 mm"\ncord_diameter = "0.55 mm"', 'spacing = "24 mm"\ncord_diameter = "19 mm"',
                 "the cord does not fit into it")):
            with self.subTest(new=new):
                tire = self.changed(self.FE, (pattern, new))
                for arguments in (("check", tire), ("mesh", tire), ("test", tire, '{kind = "mass_properties"}'),
                                  ("export", tire, "--ccx", self.folder / "x.inp")):
                    self.assertIn(says, self.run_it(*arguments, code=WRONG_INPUT))

    def test_angles_of_cords_that_do_not_fit_each_other_are_warnings(self):
        tire = TREE / "studies" / "tires" / "passenger_205_55R16.toml"
        self.assertNotIn("layer", self.run_it("check", tire).split("Numbers a study may vary")[0])
        for pattern, new, says in (('angle = "90 deg"', 'angle = "0 deg"', "no layer that reaches the beads has cords across"),
                                   ('angle = "-24 deg"', 'angle = "24 deg"', "they do not cross")):
            self.assertIn(says, self.run_it("check", self.changed(tire, (pattern, new))))
        both = self.changed(tire, ('angle = "24 deg"', 'angle = "66 deg"'), ('angle = "-24 deg"', 'angle = "-66 deg"'))
        self.assertIn("angles above 45 deg", self.run_it("check", both))

    def test_a_cord_stiffer_in_compression_than_in_tension_is_a_warning(self):
        says = "a cord is at most as stiff as in tension, 1.1e+05 MPa"
        tire = self.changed(self.FE, ('compression_modulus = "55 GPa"', 'compression_modulus = "550 GPa"'))
        for arguments in (("check", tire), ("test", tire, '{kind = "mass_properties"}')):
            self.assertIn(says, self.run_it(*arguments))
        self.assertNotIn("in tension", self.run_it("check", self.FE))

    def test_a_test_alone_has_usual_numbers_too(self):
        for keys, says in (('pressure = "300 bar"', "0.3 to 16 bar"), ('load = "4 MN", directions = ["vertical"]', "a wheel load")):
            kind = "static_stiffness" if "load" in keys else "load_deflection"
            more = "" if "load" in keys else ', deflections = ["20 mm"]'
            self.assertIn(says, self.run_it("test", self.TIR, f'{{kind = "{kind}", {keys}{more}}}', code=WRONG_INPUT))
        test = self.folder / "test.toml"
        test.write_text('kind = "load_deflection"\ndeflections = ["20 mm"]\npressure = "300 bar"\n')
        self.assertIn("test.toml:3: pressure", self.run_it("test", self.RING, test, code=WRONG_INPUT))

    def test_notes_on_a_tir_are_shown_wherever_it_is_used(self):
        tir = self.changed(self.TIR, (r"FNOMIN +=.*", "FNOMIN = 4"))
        says = "FNOMIN is 4 N, where tires have 10 to 1e+06 N"
        suite = self.folder / "suite.toml"
        suite.write_text('[test.pressed]\nkind = "load_deflection"\ndeflections = ["20 mm"]\n'
                         '[check.a]\nchannel = "pressed/force"\nof = "first"\nlower = "1 N"\nsource = "none"\n')
        (self.folder / "f.csv").write_text("deflection [mm], force [N]\n10, 1700\n20, 3500\n")
        study = self.folder / "study.toml"
        study.write_text(f'model = "{tir.name}"\n[variable.k]\npath = "VERTICAL_STIFFNESS"\nlower = "100 N/mm"\n'
                         'upper = "300 N/mm"\ninitial = "150 N/mm"\n[experiment.pressed]\nkind = "load_deflection"\n'
                         'measurement = "f.csv"\n')
        for arguments in (("check", tir), ("test", tir, self.PRESSED), ("validate", tir, suite), ("check", study),
                          ("simulate", study)):
            run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300)
            self.assertIn(says, run.stderr, arguments)
        self.assertIn("Nothing is refused, but there ", self.run_it("check", study))

    def test_a_wrong_sign_is_told_as_one_within_the_data(self):
        tir = self.changed(self.TIR, (r"PKY1 +=.*", "PKY1 = 8.9"))
        self.assertIn("within the data already, ", self.run_it("check", tir))
        # another faulty coefficient, which a test reports too
        rising = self.changed(self.TIR, (r"LMUY +=.*|PDY1 +=.*", "PDY1 = 100"))
        self.assertIn("beyond the data", self.run_it("test", rising, self.PRESSED))

    def test_what_a_table_of_states_lacks_is_told(self):
        states = self.folder / "states.csv"
        test = '{kind = "steady_states", states = "%s"}' % states
        states.write_text("Fz [N]\n4000\n")
        self.assertIn("kappa = 0, alpha = 0, gamma = 0, Vx = 11.11 m/s, p = 2.4 bar are taken", self.run_it("test", self.TIR, test))
        states.write_text("Fz [N],alpha [deg],phit [1/m],p [bar]\n4000,2,0.1,1\n")
        text = self.run_it("test", self.TIR, test)
        self.assertIn('"phit" (phit) is not used: turn_slip of the test is "off"', text)
        self.assertIn("column p has no effect", text)
        self.assertIn("kappa = 0, gamma = 0, Vx = 11.11 m/s are taken", text)
        self.assertNotIn("-0,", text.replace("-0.", ""))
        states.write_text("Fz [N],gamma [deg]\n4000,90\n4000,90\n")
        self.assertIn("is outside of -65 .. 65 deg", self.run_it("test", self.TIR, test))

    def test_a_log_of_both_streams_keeps_whole_lines(self):
        with open(self.folder / "log", "w") as log:
            subprocess.run([LATSCH, "check", self.TIR], stdout=log, stderr=log, check=True)
        lines = (self.folder / "log").read_text().splitlines()
        self.assertTrue(any(line.startswith("latsch: ") for line in lines))
        self.assertFalse([line for line in lines if "latsch: " in line[1:]])


if __name__ == "__main__":
    unittest.main()
