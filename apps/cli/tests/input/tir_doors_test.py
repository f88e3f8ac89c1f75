#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests .tir files through the program: curves, ring parameters, static and rolling tests, and the message of a study
whose tire leaves the validity ranges of its file."""

import html
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, WRONG_INPUT, Coarse

TIR = pathlib.Path(__file__).resolve().parents[4] / "studies" / "tire_model_comparison" / "rigid_ring.tir"

CURVE = "[DEFLECTION_LOAD_CURVE]\n{pen fz}\n0 0\n0.01 2000\n0.02 5000\n"

STUDY = """model = "t.tir"
[test.rolled]
kind = "rolling_stiffness"
load = "4 kN"
measures = ["slip"]
[test.steady]
kind = "steady_states"
states = "s.csv"
turn_slip = "on"
[variable.k]
path = "PKX1"
lower = 10
upper = 25
initial = 14
[experiment.slip]
kind = "values"
channel = "rolled/slip_stiffness"
value = "60000 N"
[experiment.Fx]
kind = "curve"
y = "steady/Fx"
measurement = "f.csv"
[run]
workers = 1
intervals = false
"""


class TirDoors(unittest.TestCase):
    assert_says = Coarse.assert_says

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_tir_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def tire(self, *lines, more=""):
        """Returns a tire of the repository with some lines replaced, by their keys, or added to [MODEL]."""
        text = TIR.read_text()
        for line in lines:
            key = line.split()[0]
            text = "".join(one for one in text.splitlines(True) if not one.startswith(key + " "))
            if "=" in line:
                text = text.replace("[DIMENSION]", line + "\n[DIMENSION]", 1)
        self.write("t.tir", text + more)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300, cwd=self.folder)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def answer(self, *arguments):
        run = subprocess.run([LATSCH, *arguments, "--json"], capture_output=True, text=True, timeout=300, cwd=self.folder)
        return json.loads(run.stdout)

    def channel(self, test, name, kind="magic_formula"):
        channels = self.answer("test", "t.tir", test, "--kind", kind)["result"]["channels"]
        return next(c["values"] for c in channels if c["name"] == name)

    def test_the_curve_of_a_file_counts_in_every_test_and_model(self):
        self.tire("GRAVITY = 0", more=CURVE)
        self.write("s.csv", "Fz [N]\n4000\n")
        steady = '{kind = "steady_states", states = "s.csv"}'
        self.assertAlmostEqual(self.channel(steady, "rho")[0], 0.01 + 2000 / 3e5, 9)
        for kind in ("magic_formula", "rigid_ring"):
            stiffness = self.channel('{kind = "static_stiffness", load = "4 kN", directions = ["vertical"]}', "vertical", kind)
            self.assertAlmostEqual(stiffness[0] / 3e5, 1.0, 3, kind)
            forces = self.channel('{kind = "load_deflection", deflections = ["5 mm", "15 mm"]}', "force", kind)
            self.assertAlmostEqual(forces[0], 1000.0, 2, kind)
            self.assertAlmostEqual(forces[1], 3500.0, 2, kind)
        self.assert_says(self.latsch("check", "t.tir"), "replaces the formula of the vertical force", "Q_FZ2")

    def test_curves_of_no_tire_are_refused(self):
        for rows, said in (("0 0\n0.01 5000\n0.02 2000\n", "does not rise"), ("0 0\n10 2000\n20 5000\n", "millimeters"),
                           ("0 0 1\n0.01 2000 1\n", "3 numbers")):
            self.tire(more="[DEFLECTION_LOAD_CURVE]\n" + rows)
            self.assert_says(self.latsch("check", "t.tir", code=WRONG_INPUT), "t.tir:", said)

    def test_the_rigid_ring_says_what_it_assumes_and_what_contradicts(self):
        stand = '{kind = "static_stiffness", load = "4 kN", directions = ["vertical"]}'
        ring = lambda **options: self.latsch("test", "t.tir", stand, "--kind", "rigid_ring", **options)
        self.tire("ELLIPS_SHIFT", "ELLIPS_HEIGHT")
        self.assert_says(ring(), "ELLIPS_SHIFT = 0.8", "ELLIPS_HEIGHT = 1", "are assumed")
        self.tire("LATERAL_STIFFNESS = 97e6")
        self.assert_says(ring(), "LATERAL_STIFFNESS is 9.7e+04 N/mm", "FREQ_LAT")
        self.tire("LONGITUDINAL_STIFFNESS = 1764.69")
        self.assert_says(ring(), "LONGITUDINAL_STIFFNESS is 1.765 N/mm", "FREQ_LONG", "times as stiff")
        for line, said in (("ELLIPS_LENGTH = 0", "ELLIPS_LENGTH is 0"), ("FREQ_LONG = 6.8", "FREQ_LONG = 6.8 Hz")):
            self.tire(line)
            self.assert_says(ring(code=WRONG_INPUT), said)

    def test_a_standing_tire_has_no_stiffness_that_its_file_lacks(self):
        stand = '{kind = "static_stiffness", load = "4 kN"}'
        self.tire("LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS")
        self.assert_says(self.latsch("test", "t.tir", stand, "--kind", "magic_formula", code=WRONG_INPUT),
                         "no longitudinal stiffness", "LONGITUDINAL_STIFFNESS")
        self.tire("YAW_STIFFNESS")
        self.assert_says(self.latsch("test", "t.tir", stand, "--kind", "magic_formula"), "no YAW_STIFFNESS", "0.05 rad")
        self.assert_says(self.latsch("check", "t.tir"), "YAW_STIFFNESS is taken as")

    def prepare_study(self, *lines):
        self.tire(*lines)
        self.write("s.csv", "Fz [N],kappa,phit [1/m]\n2000,0.02,0.01\n4000,0.02,0\n6000,0.02,0\n")
        self.write("f.csv", "Fx [N]\n600\n1200\n1800\n")
        self.write("study.toml", STUDY)

    def test_a_study_says_once_which_ranges_its_tire_leaves(self):
        self.prepare_study("FZMAX = 3000")
        turning, rolling = 'turn_slip = "on" has no effect', "Fz is 4000 N in this test, above FZMAX = 3000 N"
        steady = "test steady: 2 of 3 states lie outside"
        checked = self.latsch("check", "study.toml")
        self.assert_says(checked, "test steady: the tire has no turn slip", turning, steady)
        for verb in ("simulate", "run"):
            warnings = self.answer(verb, "study.toml")["warnings"]
            for part in (turning, rolling, steady):
                found = [one for one in warnings if part in json.dumps(one, ensure_ascii=False).replace('\\"', '"')]
                self.assertEqual(len(found), 1, (verb, part, warnings))
            self.assertTrue(any("test rolled: Fz is 4000 N" in json.dumps(one) for one in warnings), warnings)

    def test_result_and_report_show_the_ranges_that_are_left(self):
        self.prepare_study("FZMAX = 3000")
        left = "test rolled: Fz is 4000 N in this test, above FZMAX = 3000 N"
        for verb in ("simulate", "run"):
            limits = self.answer(verb, "study.toml")["result"]["limits"]
            self.assertEqual(sum(left in one for one in limits), 1, limits)
        page = html.unescape((self.folder / "study.html").read_text())
        self.assertTrue("Warning: " + left in page)
        self.assertTrue('"limits":["' + left in page, "the answers of its live view")

    def test_compare_says_which_ranges_its_tires_leave(self):
        self.tire("FZMAX = 3000")
        (self.folder / "t.tir").rename(self.folder / "low.tir")
        self.tire()
        self.write("drum.toml", 'kind = "drum_cleat"\nspeed = "40 km/h"\nload = "4 kN"\ndrum_diameter = "2.5 m"\nrun_in = "0.1 s"\n'
                                'duration = "0.256 s"\nlead = "0.03 s"\nsample_step = "1 ms"\n[cleat]\nheight = "10 mm"\nlength = "60 mm"\n')
        self.write("c.toml", '[specimen]\nkind = "magic_formula"\nfile = "t.tir"\n[test.bar]\nfile = "drum.toml"\n'
                             '[tire.low]\nkind = "rigid_ring"\nfile = "low.tir"\n[tire.full]\nkind = "magic_formula"\nfile = "t.tir"\n')
        answer = self.answer("compare", "c.toml")
        low, full = answer["result"]["tires"]
        self.assertTrue(any("above FZMAX = 3000 N" in one and "(bar)" in one for one in low["limits"]), low)
        self.assertFalse(any("FZMAX" in one for one in full["limits"]), full)
        self.assertTrue(any("low: Fz is" in json.dumps(one) for one in answer["warnings"]), answer["warnings"])
        self.assertIn("above FZMAX = 3000 N", (self.folder / "c.html").read_text())

    def test_a_study_within_the_ranges_says_nothing_of_them(self):
        self.prepare_study("FZMAX = 9000")
        self.write("study.toml", STUDY.replace('turn_slip = "on"', 'turn_slip = "off"'))
        for verb in ("check", "simulate", "run"):
            said = self.latsch(verb, "study.toml")
            for part in ("turn slip", "states lie outside", "in this test"):
                self.assertNotIn(part, said, verb)


if __name__ == "__main__":
    unittest.main()
