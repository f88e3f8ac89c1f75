#!/usr/bin/env python3
"""Tests recorders' files (MDF 4, universal file 58) through show, a study's measurement and process.

   recorder_files_test.py PATH/TO/latsch"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cli_testing import DONE, LATSCH, WRONG_INPUT  # noqa: E402

WRITER = pathlib.Path(__file__).resolve().parents[4] / "verification" / "recorders" / "write_recordings.py"


class Recorders(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_recorders_"))
        subprocess.run([sys.executable, WRITER, cls.folder], check=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return " ".join((run.stdout + run.stderr).split())

    def test_show_lists_the_groups_with_their_rates(self):
        text = self.latsch("show", self.folder / "unsorted_1.mf4")
        self.assertIn("MDF 4.10", text)
        self.assertIn("slow 5 250 Hz 0 s 0.016 s time [s], Fz [N]", text)
        self.assertIn("fast 20 1000 Hz 0 s 0.019 s time [s], Fz [kN]", text)
        self.assertIn('group = "slow"', text)
        self.assertIn("cut off and is not read", text)

    def test_show_reads_a_universal_file_and_names_what_it_leaves_out(self):
        text = self.latsch("show", self.folder / "functions.uff")
        self.assertIn("Universal file (data set 58)", text)
        self.assertIn("is of type 9, expected 1, 2, 3, 4, 6 or 12", text)
        self.assertIn("frequency 1", text)
        self.assertIn("point 12 at 0.1, 0, -0.25 m", self.latsch("show", self.folder / "text_2_even.uff"))

    def test_a_spoiled_file_is_one_sentence_that_names_it(self):
        spoiled = self.folder / "spoiled.mf4"
        spoiled.write_bytes((self.folder / "plain.mf4").read_bytes()[:-500])
        text = self.latsch("show", spoiled, code=WRONG_INPUT)
        self.assertIn("spoiled.mf4", text)
        spoiled.unlink()

    def measurement(self, keys):
        """Returns what show says of a study's measurement of the unsorted file."""
        study = self.folder / "study.toml"
        study.write_text(f'[measurement.logged]\nfile = "unsorted_1.mf4"\n{keys}\n[experiment]\n')
        return ["show", study, "--measurement", "logged"]

    def test_a_measurement_names_a_group_or_joins_them(self):
        self.assertIn("20 samples of 2 channels", self.latsch(*self.measurement('group = "fast"')))
        text = self.latsch(*self.measurement('resample = "2 ms"'))
        self.assertIn("9 samples of 3 channels", text)
        self.assertIn("2 groups at a step of 0.002 s,", text)
        text = self.latsch(*self.measurement('group = "fats"'), code=WRONG_INPUT)
        self.assertIn('has no group "fats", did you mean "fast"?', text)
        text = self.latsch(*self.measurement('group = "fast"\nresample = "1 ms"'), code=WRONG_INPUT)
        self.assertIn("is given beside resample", text)

    def test_resampling_a_table_of_one_time_is_refused(self):
        (self.folder / "one.csv").write_text("time [s],Fz [N]\n0,1\n1,2\n")
        study = self.folder / "one.toml"
        study.write_text('[measurement.logged]\nfile = "one.csv"\nresample = "1 ms"\n[experiment]\n')
        text = self.latsch("show", study, "--measurement", "logged", code=WRONG_INPUT)
        self.assertIn("has one time for all channels, but resample is stated", text)


if __name__ == "__main__":
    unittest.main()
