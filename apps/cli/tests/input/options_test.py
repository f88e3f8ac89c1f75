#!/usr/bin/env python3
"""Tests that an option without effect in the chosen form of a verb is refused with the reason, and that nothing is
written.

   options_test.py PATH/TO/latsch"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import LATSCH, WRONG_INPUT, Coarse

STUDIES = pathlib.Path(__file__).resolve().parents[4] / "studies"
FE_TIRE = STUDIES / "tires" / "passenger_205_55R16.toml"
RING = STUDIES / "ring_tires" / "passenger_205_55R16.toml"
TIR = STUDIES / "tire_model_comparison" / "rigid_ring.tir"


class Options(unittest.TestCase):
    latsch = Coarse.latsch
    assert_says = Coarse.assert_says

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_options_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def refused(self, option, *arguments, says=()):
        said = self.latsch(*arguments, code=WRONG_INPUT, cwd=self.folder)
        self.assert_says(said, option, "expected", *says)
        self.assertEqual(list(self.folder.iterdir()), [], f"{arguments} wrote a file")

    def test_new_refuses_options_of_another_form(self):
        for option, *value in (("--cleat", "10 mm x 20 mm"), ("--known", RING), ("--axes", "sae"), ("--teeth", "60"),
                               ("--radius", "300 mm"), ("--drum-diameter", "2 m"), ("--column", "Fz = F"),
                               ("--hold-out", "p = 1 kPa .. 2 kPa")):
            with self.subTest(option):
                self.refused(option, "new", "x", option, *value, says=["has no effect here"])
        self.refused("--size", "new", "x", "--size", "", says=["empty"])
        self.refused("--coarse", "new", "x", "--car", "--coarse", says=["writes a study of a car"])
        self.refused("--known", "new", "x", "--magic-formula", "c.csv", "--known", RING, says=["--ring-data or --drum"])

    def test_new_refuses_two_forms_at_once(self):
        drum = ["--drum", "r.csv", "--cleat", "10 mm x 20 mm"]
        for other in (["--magic-formula", "c.csv"], ["--suspension"], ["--size", "275/35R19"], ["--car"],
                      ["--tire", "race_16x7.5-10"], ["--ring-data"]):
            with self.subTest(other):
                self.refused(other[0], "new", "x", *drum, *other, says=["--drum", "expected one of them"])
        self.refused("--size", "new", "x", "--size", "275/35R19", "--tire", "race_16x7.5-10", says=["--tire"])
        self.refused("--car", "new", "x", "--suspension", "--car", says=["--suspension"])
        self.refused("--coarse", "new", "x", *drum, "--coarse")

    def test_export_refuses_options_without_effect(self):
        for arguments in (["--pressure", "3 bar", "--model", "y.tir"], ["--modes", "5", "--model", "y.tir"],
                          ["--deflection", "9 mm", "--model", "y.tir"],
                          ["--pressure", "3 bar", "--fmu", "2.0", "-o", "x.fmu"], ["--road", "r.toml", "--model", "y.tir"],
                          ["--platforms", "linux", "--model", "y.tir"],
                          ["--output", "x.tir", "--model", "y.tir"], ["--pressure", "3 bar", "--sti"]):
            with self.subTest(arguments):
                self.refused(arguments[0], "export", TIR, *arguments, says=["has no effect here"])
        self.refused("--vtu", "export", "s.toml", "--measurements", "--vtu", "x.vtu")

    def test_export_takes_them_beside_a_form_that_uses_them(self):
        self.latsch("export", FE_TIRE, "--ccx", "x.inp", "--pressure", "3 bar", "--model", "y.toml", cwd=self.folder)
        self.assertTrue((self.folder / "x.inp").exists() and (self.folder / "y.toml").exists())

    def test_other_verbs_refuse_options_without_effect(self):
        drum = STUDIES / "tire_model_comparison" / "comparison.toml"
        for option, *arguments in (
                ("--deflection", "mesh", FE_TIRE, "--deflection", "9 mm"), ("--finest", "mesh", FE_TIRE, "--finest", "3"),
                ("--choose-sectors", "mesh", FE_TIRE, "--choose-sectors"), ("--thorough", "mesh", FE_TIRE, "--thorough"),
                ("--unknowns", "mesh", FE_TIRE, "--convergence", "--unknowns", "9000"),
                ("--modes", "mesh", FE_TIRE, "--modes", "6"),
                ("--thorough", "mesh", FE_TIRE, "--convergence", "--thorough"),
                ("--html", "test", TIR, "{}", "--convergence", "--html", "x.html"),
                ("--output", "test", TIR, "{}", "--convergence", "-o", "x.csv"),
                ("--signs", "test", TIR, "{}", "--convergence", "--signs", "sae"),
                ("model", "test", "--list", TIR), ("--kind", "test", "--list", "--kind", "fe_tire"),
                ("--output", "compare", drum, "--write-measurements", "m", "-o", "x.html"),
                ("--threads", "compare", drum, "--threads", "4"), ("--time", "road", "k.toml", "--triangles", "t.rdf", "--time", "1 s"),
                ("--output", "road", "k.toml", "--triangles", "t.rdf", "--output", "o.csv"),
                ("--study", "doctor", "x.latsch", "--study", "s.toml"),
                ("--kind", "test", STUDIES / "tire_b_twin" / "study.toml", "{}", "--kind", "fe_tire"),
                ("--kind", "validate", STUDIES / "tire_b_twin" / "study.toml", "s.toml", "--kind", "fe_tire")):
            with self.subTest(arguments):
                self.refused(option, *arguments)
        self.latsch("compare", drum, "--threads", "-3", code=WRONG_INPUT)

    def test_show_simulate_and_pareto(self):
        study = STUDIES / "tire_b_twin" / "study.toml"
        self.refused("--axes", "show", TIR, "--axes", "sae", says=["no effect"])
        self.refused("--set", "simulate", study, "--set", "matrix=12 N/mm^2", "--set", "matrix=13 N/mm^2", says=["matrix is set twice"])
        self.refused("--set", "simulate", study, "--set", "z=5 N/mm^2", says=['no variable "z"; expected "matrix"'])
        # Values of a stiffness need a unit, and no text can break the error message.
        for value in ("5 %", '5" N', "5\\", "12", "nan"):
            self.refused("matrix", "simulate", study, "--set", f"matrix={value}", says=["expected"])
        self.refused("pareto", "pareto", study, "modes", "modes", says=["against itself"])

    def test_serve_names_its_address_with_quiet_and_refuses_a_model(self):
        served = subprocess.Popen([LATSCH, "serve", self.folder, "--no-browser", "--quiet"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(served.stdout.close)
        self.assertIn("http://", served.stdout.readline())
        served.terminate()
        served.wait(timeout=30)
        self.refused("not a study", "serve", TIR, "--no-browser")
        self.refused("not a study", "serve", "/dev/null", "--no-browser")

    def test_serve_says_that_a_folder_holds_no_study(self):
        empty = self.folder / "empty"
        empty.mkdir()
        served = subprocess.Popen([LATSCH, "serve", empty, "--no-browser"], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        self.addCleanup(served.stdout.close)
        self.addCleanup(served.stderr.close)
        self.assertIn("no study in this folder", served.stderr.readline())
        self.assertIn("http://", "".join(served.stdout.readline() for _ in range(2)))
        served.terminate()
        served.wait(timeout=30)

    def test_an_empty_text_is_no_value(self):
        for arguments in (["test", TIR, "{}", "-o", ""], ["export", TIR, "--model", ""], ["report", ""],
                          ["mesh", FE_TIRE, "--convergence", "--deflection", ""]):
            with self.subTest(arguments):
                self.refused("empty", *arguments)


if __name__ == "__main__":
    unittest.main()
