#!/usr/bin/env python3
"""Cells, headers, units and encodings of a recording: what is read, and what is refused in which words.

    columns_test.py PATH/TO/latsch
"""
import pathlib
import resource
import shutil
import subprocess
import tempfile
import time
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT
from ledger_test import GOOD, STUDY, TIR

STATES = '{{kind = "steady_states", states = "{}"}}'


class Columns(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_columns_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "tire.tir").write_text(TIR)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, timeout=300)
        text = (run.stdout + run.stderr).decode("utf-8", "replace")
        if code is not None:
            self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{text}")
        return text

    def check(self, table, code=DONE, more="", name="record.csv"):
        data = table if isinstance(table, bytes) else table.encode()
        (self.folder / name).write_bytes(data)
        (self.folder / "study.toml").write_text(STUDY.format(file=name, more=more))
        return self.latsch("check", self.folder / "study.toml", code=code)

    def states(self, table, code=DONE, name="states.csv"):
        (self.folder / name).write_text(table)
        return self.latsch("test", self.folder / "tire.tir", STATES.format(name), code=code)

    def test_exponents_of_fortran_are_read(self):
        expected = self.states("Fz [N],alpha [deg]\n4000,2\n4000,-2\n")
        self.assertEqual(self.states("Fz [N],alpha [deg]\n4.000000D+03,2.0D0\n0.4d4,-.2D+01\n"), expected)
        self.assertIn("Everything is in order", self.check(GOOD.replace(",-3,", ",-3.0D+00,")))
        dat = "Tire 1\nET\tSA\tFZ\tFY\nsec\tdeg\tN\tN\n0.1D0\t-1.0D0\t9.0D2\t3.0D2\n2.0D0\t2.0D0\t9.0D2\t-6.0D2\n"
        self.assertIn("2 steady states", self.check(dat, name="record.dat"))
        for no_number in ("1.2D", "D+03", "1D2D3", "1.2DEG"):
            self.assertIn(f'"{no_number}" in line 2', self.check(GOOD.replace(",-3,", f",{no_number},"), code=WRONG_INPUT))

    def test_a_cell_that_is_no_number_says_what_it_holds(self):
        for cell, words in {"3 deg": "a number with a unit: write [deg] behind the name",
                            "4°": "a number with a unit", "(3.5": "a negative one begins with a minus",
                            "####": "too narrow", "mean": "a text among numbers", "1'200.5": "thousands separators"}.items():
            text = self.check(GOOD.replace(",-3,", f",{cell},"), code=WRONG_INPUT)
            self.assertIn(f'SA is "{cell}" in line 2', text)
            self.assertIn(words, text)
            self.assertIn("record.csv", text)

    def test_minutes_of_arc_and_a_toe_in_millimeters_are_named(self):
        for title, words in {"SA [min]": '"arcmin"', "SA [sec]": '"arcsec"', "Toe [mm]": "asin(toe / d)"}.items():
            text = self.check(GOOD.replace("SA [deg]", title), code=WRONG_INPUT)
            self.assertIn(words, text)
            self.assertIn(f'is in "{title[title.index("[") + 1:-1]}", expected an angle', text)

    def test_missing_columns_are_answered_with_the_names_of_the_file(self):
        text = self.check("Einfederung [mm],Sturz [deg],Kanal 7 [N]\n1,2,3\n1,2,3\n", code=WRONG_INPUT)
        for part in ('"Einfederung" (deflection)', '"Sturz" (gamma)', '"Kanal 7"'):
            self.assertIn(part, text)
        text = self.states("Last [N],Sturz [deg]\n4000,1\n", WRONG_INPUT)
        self.assertIn('(columns: "Last" or "Sturz")', text)

    def test_a_unit_in_a_name_is_read_everywhere(self):
        expected = self.states("Fz [N],alpha [deg],Vx [km/h]\n4000,2,40\n")
        self.assertEqual(self.states("Fz_kN,SA_deg,V_kmh\n4,2,40\n"), expected)
        self.assertEqual(self.states("FZ_N,slip_angle_deg,Vx_kmh\n4000,2,40\n"), expected)
        (self.folder / "names.csv").write_text("Fz [N],SA_deg\n4000,2\n4000,-2\n")
        shown = self.latsch("show", self.folder / "names.csv")
        self.assertRegex(shown, r"SA_deg +rad")
        self.assertIn("0.0349066", shown)

    def test_full_width_letters_and_brackets_are_read(self):
        expected = self.states("Fz [N],SA [deg]\n4000,2\n")
        self.assertEqual(self.states("Ｆｚ［N］,SA［ｄｅｇ］\n4000,2\n"), expected)
        self.assertEqual(self.states("Fz（N）,SA　（deg）\n4000,2\n"), expected)

    def test_show_fails_where_no_channel_was_read(self):
        (self.folder / "texts.csv").write_text("foo,bar\nx,y\n")
        self.assertIn("no channels", self.latsch("show", self.folder / "texts.csv", code=WRONG_INPUT))
        (self.folder / "good.csv").write_text(GOOD)
        self.latsch("show", self.folder / "good.csv")

    def test_an_assumed_encoding_is_told(self):
        german = GOOD.replace("SA [deg]", "Schräglaufwinkel [°]")
        self.assertNotIn("encoding", self.check(german))
        text = self.check(german.encode("cp1252"))
        self.assertIn("encoding Windows-1252, because the bytes are no UTF-8", text)
        self.assertIn("Everything is in order", text)
        text = self.check(GOOD.replace("TSTC [degC]", "温度 [N]").encode("shift_jis"))
        self.assertIn("they look like Shift-JIS", text)
        self.assertIn("warning", text)

    def test_a_long_and_a_wide_file_end_soon(self):
        rows = 300_000
        line = "4000.5,1.25,-0.5,123.25,7.5,60.5\n"
        (self.folder / "long.csv").write_text("FZ [N],SA [deg],IA [deg],FY [N],MZ [N m],TSTC [degC]\n" + line * rows)
        (self.folder / "wide.csv").write_text(",".join(f"c{i} [N]" for i in range(200_000)) + "\n" + ",".join(["1"] * 200_000) + "\n")
        (self.folder / "broad.csv").write_text(",".join(f"c{i} [N]" for i in range(9_000)) + "\n" + ",".join(["1"] * 9_000) + "\n")
        for name, code in (("long.csv", DONE), ("wide.csv", WRONG_INPUT), ("broad.csv", DONE)):
            begin = time.monotonic()
            text = self.latsch("show", self.folder / name, code=code)
            self.assertLess(time.monotonic() - begin, 60.0, name)
            if name == "wide.csv":
                self.assertIn("more than 10000 fields", text)
        most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024  # MB
        self.assertLess(most, 2000)


if __name__ == "__main__":
    unittest.main()
