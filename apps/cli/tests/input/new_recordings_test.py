#!/usr/bin/env python3
"""Tests recordings that `latsch new --magic-formula` cannot use. Each is refused, and the message names the missing
channel and the columns that may contain it.

   new_recordings_test.py PATH/TO/latsch"""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import WRONG_INPUT
from doubtful_data_test import Data


class Recordings(Data):
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



if __name__ == "__main__":
    unittest.main()
