#!/usr/bin/env python3
"""Tests the messages and the exit status of the program for invalid input and for a full disk.

   bad_input_test.py PATH/TO/latsch"""
import os
import resource
import signal
import unittest
import unittest.mock

from cli_testing import FAILED, WRONG_INPUT, Coarse, edit


class BadInput(Coarse):
    def rejected(self, verb, *parts):
        text = self.latsch(verb, self.study, code=WRONG_INPUT)
        self.assert_says(text, *parts)

    def test_unknown_verb(self):
        text = self.latsch("runn", code=WRONG_INPUT)
        self.assert_says(text, 'no verb "runn"', 'did you mean "run"?', "--help")

    def test_what_a_former_verb_did_is_said(self):
        for verb, now in (("ring", "latsch new FOLDER --ring-data"), ("evaluate", "latsch test MODEL TEST")):
            self.assert_says(self.latsch(verb, "x.toml", code=WRONG_INPUT), f'no verb "{verb}" any more', now)

    def test_data_of_a_former_verb_are_said_to_be_a_study_now(self):
        self.study.write_text('tire = "tire.toml"\n[target.first_load]\nkind = "load"\n')
        self.rejected("run", "is measured data of a ring", "latsch new FOLDER --ring-data")

    def test_unknown_option_and_missing_study(self):
        text = self.latsch("run", self.study, "--wrkers", "2", code=WRONG_INPUT)
        self.assert_says(text, 'latsch run: no option "--wrkers"', 'did you mean "--workers"?', "latsch run --help")
        self.assert_says(self.latsch("run", code=WRONG_INPUT), "latsch run: study is required")
        self.assert_says(self.latsch("run", self.study, "more", code=WRONG_INPUT), 'unexpected argument "more"')
        self.assert_says(self.latsch("check", self.folder, code=WRONG_INPUT), "is a folder, expected a file")

    def test_a_kernel_set_that_is_none(self):
        self.assert_says(self.latsch("--version"), "latsch 0.1.0 (", "kernels ", "Eigen 3.", "OpenBLAS ", "SQLite ", "page ")
        with unittest.mock.patch.dict(os.environ, LATSCH_KERNELS="avx9"):
            self.rejected("check", 'LATSCH_KERNELS is "avx9"', "expected one of: baseline")
        with unittest.mock.patch.dict(os.environ, LATSCH_KERNELS="baseline"):
            self.assert_says(self.latsch("--version"), "kernels baseline")

    def test_misspelled_table(self):
        edit(self.study, (r"\[variable\.carcass\]", "[variables.carcass]"))
        edit(self.study, (r"\[experiment\.", "[experiments."))
        self.rejected("check", "study.toml", "unknown table [variables]", 'did you mean "variable"?')

    def test_files_of_another_kind(self):
        ring = self.folder / "ring.toml"
        ring.write_text('kind = "ring_tire"\n')
        self.assert_says(self.latsch("check", ring, code=WRONG_INPUT), "ring.toml:1: ", "belt is missing")
        self.assert_says(self.latsch("mesh", ring, code=WRONG_INPUT), "ring.toml:1: ", "a tire of finite elements")
        tir = self.folder / "tire.tir"
        tir.write_text("$ a comment\n[MODEL]\n")
        self.assert_says(self.latsch("check", tir, code=WRONG_INPUT), "tire.tir")

    def test_settings_in_the_wrong_table(self):
        edit(self.study, (r"\[run\]", "[run]\nmax_steps = 5"))
        self.rejected("check", "study.toml:", "run.max_steps belongs in [optimizer]")

    def test_doctor_of_a_study_that_never_ran(self):
        self.rejected("doctor", "study.toml", "study.latsch does not exist yet", "latsch run")

    def test_an_option_without_its_unit(self):
        text = self.latsch("mesh", self.folder / "tire.toml", "--convergence", "--deflection", "8", code=WRONG_INPUT)
        self.assert_says(text, '--deflection is "8", expected a length such as')

    def test_negative_thickness(self):
        edit(self.folder / "tire.toml", (r'\[0.0, "6 mm"\]', '[0.0, "-6 mm"]'))
        self.rejected("check", "tire.toml", "thickness")

    def test_cord_angle_in_newtons(self):
        edit(self.folder / "tire.toml", ('angle = "24 deg"', 'angle = "22 N"'))
        self.rejected("check", "tire.toml", 'layer.belt_1.angle is "22 N"', "deg")

    def test_inverted_mesh(self):
        edit(self.folder / "tire.toml", (r"\[67, 303.5\], \[84, 298\]", "[84, 303.5], [67, 304]"))
        self.rejected("check", "tire.toml", "contour")

    def test_path_that_does_not_exist(self):
        edit(self.study, ("layer.carcass.young_modulus", "layer.carcas.young_modulus"))
        self.rejected("check", "study.toml", "variable.carcass.path", "layer.carcass.young_modulus")

    def test_empty_measurement(self):
        (self.folder / "stiffness.csv").write_text("")
        self.rejected("check", "stiffness.csv")

    def test_nan_in_a_measurement(self):
        (self.folder / "stiffness.csv").write_text("deflection [mm], force [N]\n6, nan\n")
        self.rejected("check", "stiffness.csv:2")

    def test_study_that_does_not_exist(self):
        self.study.unlink()
        self.rejected("run", "study.toml")

    def test_nothing_to_resume(self):
        self.rejected("resume", "nothing to resume", "latsch run")

    def test_journal_of_another_study(self):
        self.latsch("doe", self.study, "--levels", "2")
        edit(self.folder / "tire.toml", ('angle = "24 deg"', 'angle = "26 deg"'))
        self.rejected("resume", "study.latsch", "model")
        self.rejected("report", "study.latsch", "model")

    def test_unknown_variable_on_the_command_line(self):
        text = self.latsch("simulate", self.study, "--set", "sidewal=5 MPa", code=WRONG_INPUT)
        self.assert_says(text, "sidewal", "did you mean", "sidewall")

    def test_pressure_that_the_wall_does_not_bear(self):
        edit(self.study, ('pressure = "2.4 bar"', 'pressure = "900 bar"'))
        text = self.latsch("simulate", self.study, code=FAILED)
        self.assert_says(text, "experiment", "900 bar")

    def test_full_disk(self):
        def small_files():  # every file ends at 40 kB, as on a disk that is full
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000))

        text = self.latsch("run", self.study, code=FAILED, preexec_fn=small_files)
        self.assert_says(text, "study.latsch")
        resumed = self.latsch("resume", self.study)  # no finished trial is lost or damaged
        self.assert_says(resumed, "Best of")


if __name__ == "__main__":
    unittest.main()
