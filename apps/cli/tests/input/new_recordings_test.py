#!/usr/bin/env python3
"""Tests recordings given to `latsch new`. One that it cannot use is refused, and the message names the missing channel and
the columns that may contain it. One that it can use causes the same warnings as in `latsch check`. No incomplete study
is left behind.

   new_recordings_test.py PATH/TO/latsch"""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import doubtful_data_test
from cli_testing import WRONG_INPUT


class Recordings(doubtful_data_test.Data):
    def write_sweep(self, load="Fz [N]", side_force="Fy [N]"):
        rows = [f"{0.01 * k:g},{6 * math.sin(0.1 * k):.4f},4000,{-3000 * math.sin(0.1 * k):.3f},16.7"
                for k in range(200)]
        self.write("r.csv", f"time [s],alpha [deg],{load},{side_force},Vx [m/s]\n" + "\n".join(rows) + "\n")
        return self.latsch("new", "x", "--magic-formula", "r.csv", "--radius", "0.3 m", code=WRONG_INPUT)

    def test_a_missing_load_is_named_with_the_columns_that_may_be_it(self):
        self.assert_says(self.write_sweep(load="load_corrected [N]"), "r.csv", "no column is called Fz",
                         "columns that may be it: `load_corrected`", '--column "Fz = NAME [unit]"')

    def test_a_sweep_without_its_force_is_told_from_no_sweep(self):
        self.assert_says(self.write_sweep(side_force="pull [N]"), "r.csv", "alpha goes through a sweep",
                         "no column is called Fy", "`pull`")

    def new(self, name, **signs):
        """Writes a cornering record in iso axes whose columns are multiplied by the factors `signs`; returns what
        `latsch new` prints for it."""
        rows = []
        for k in range(200):
            alpha = 6 * math.sin(0.1 * k)
            row = {"SA": alpha, "FZ": 4000, "FY": -3000 * math.sin(0.1 * k), "MZ": 20 * math.sin(0.1 * k), "V": 60}
            rows.append(",".join(f"{row[one] * signs.get(one, 1):.4f}" for one in row) + f",{0.01 * k:g}")
        self.write(f"{name}.csv", "SA [deg],FZ [N],FY [N],MZ [N m],V [km/h],ET [s]\n" + "\n".join(rows) + "\n")
        return self.latsch("new", name, "--magic-formula", f"{name}.csv", "--radius", "0.3 m")

    def test_doubts_of_a_record_are_told_when_its_study_is_written(self):
        good = self.new("good")
        self.assertNotIn("warning", good)
        self.assert_says(good, "assumed", "axes iso, because none are stated")
        self.assert_says(self.new("slip", SA=-1), "warning", "sign")
        self.assert_says(self.new("side", FY=-1), "warning", "sign")
        self.assert_says(self.new("back", V=-1), "warning", "km/h")
        self.assert_says(self.new("heavy", FZ=100, FY=100), "warning", "is it in N, kN or lbf?")

    def test_the_vertical_stiffness_is_that_at_the_nominal_pressure(self):
        rows = []
        for pressure in (180e3, 220e3, 220e3):
            for load in (2000, 4000, 6000):
                for k in range(100):
                    alpha, stiffness = 8 * math.sin(0.0628 * k), 209e3 * (1 + 0.7 * (pressure / 220e3 - 1))
                    rows.append(f"{alpha:.4f},{load},{-0.9 * load * math.tanh(0.4 * alpha):.2f},{pressure / 1e3},60,"
                                f"{0.3135 - load / stiffness:.6f},{0.01 * len(rows):.2f}")
        self.write("p.csv", "SA [deg],FZ [N],FY [N],P [kPa],V [km/h],RL [m],ET [s]\n" + "\n".join(rows) + "\n")
        self.latsch("new", "p", "--magic-formula", "p.csv")
        tire = (self.folder / "p" / "tire.tir").read_text()
        self.assertRegex(tire, r"VERTICAL_STIFFNESS *= 209000  \$ from the recordings near NOMPRES")
        self.assertRegex(tire, r"UNLOADED_RADIUS *= 0.3135 ")

    def test_an_error_names_the_option_or_the_file_that_exists(self):
        self.new("r")
        for arguments, part in ((["r.csv", "r.csv"], '--magic-formula names "r.csv" twice'),
                                (["r.csv", "--axes", "sae"], '--axes is "sae", but'),
                                (["r.csv", "--column", "Fz = LOAD [quux]"], "--column Fz is")):
            said = self.latsch("new", "wrong", "--radius", "0.3 m", "--magic-formula", *arguments, code=WRONG_INPUT)
            self.assert_says(said, part)
            self.assertNotIn("recordings:", said)
        self.write("none.csv", "SA [deg],FZ [N],FY [N]\n")
        said = self.latsch("new", "wrong", "--radius", "0.3 m", "--magic-formula", "none.csv", code=WRONG_INPUT)
        self.assert_says(said, "latsch: none.csv holds no sample")

    def test_both_statements_that_make_the_signs_agree_are_told(self):
        said = self.new("mirrored", SA=-1, MZ=-1)
        self.assert_says(said, "each of several statements", 'Fy = "-FY"', 'alpha = "-SA"', 'Mz = "-MZ"')

    def test_an_impossible_record_leaves_no_study(self):
        self.write("far.csv", "SA [deg],FZ [N],FY [N],Vx [km/h]\n" + "\n".join(
            f"{6 * math.sin(0.1 * k):.4f},4000,{-3000 * math.sin(0.1 * k):.3f},60000" for k in range(200)) + "\n")
        self.latsch("new", "far", "--magic-formula", "far.csv", "--radius", "0.3 m", code=WRONG_INPUT)
        self.assertFalse((self.folder / "far").exists())


class DrumNames(doubtful_data_test.Data):
    process = doubtful_data_test.Rig.process

    def frames(self, names):
        self.process()
        rows = (self.folder / "r.csv").read_text().split("\n", 1)[1]
        (self.folder / "named.csv").write_text(names + "\n" + rows)
        self.latsch("new", "named", "--drum", "named.csv", "--cleat", "10 mm x 20 mm")
        return (self.folder / "named" / "study.toml").read_text()

    def test_the_test_records_in_the_frame_of_the_names(self):
        study = self.frames("RUNTIME [s],LONGVEL [m/s],FZW [N]")
        self.assertIn('frame = ["W"]', study)
        self.latsch("check", "named/study.toml")

    def test_names_without_a_frame_state_none(self):
        self.assertNotIn("frame", self.frames("time [s],speed [m/s],Fz [N]"))



if __name__ == "__main__":
    unittest.main()
