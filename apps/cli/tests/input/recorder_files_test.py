#!/usr/bin/env python3
"""Tests recorders' files (MDF 4, universal file 58, TDMS, RPC III, MoTeC) through show, a study's measurement and process.

   recorder_files_test.py PATH/TO/latsch"""
import csv
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cli_testing import DONE, LATSCH, WRONG_INPUT  # noqa: E402

WRITER = pathlib.Path(__file__).resolve().parents[4] / "verification" / "recorders" / "write_recordings.py"
sys.dont_write_bytecode = True
sys.path.insert(0, str(WRITER.parent))
import rpc_files  # noqa: E402
import tdms_files  # noqa: E402
from tdms_files import DESCRIBES, HAS_DATA, NEW_LIST  # noqa: E402

# A drum of 2.5 m that turns at 10 m/s: a hit of 800 N on 1 kN every 0.8 s, 300 samples of 0.5 ms long.
STEP, PERIOD, SAMPLES, HIT = 0.0005, 1600, 16000, 300
RIG = """[channels]
speed = "speed"
force = "Fz"
{keys}
[drum]
circumference = "8 m"
[plateaus]
speeds = ["36 km/h"]
[run.tire]
file = "{file}"
"""


def pulse(i):
    return 800.0 * math.sin(math.pi * (i - 650) / HIT) ** 2 if 650 <= i < 650 + HIT else 0.0


def drum_force():
    """Returns the force in steps of 1/8 N, which 16-bit integers hold without rounding."""
    return [round(8 * pulse(i % PERIOD)) / 8 + 1000 for i in range(SAMPLES)]


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

    def write_drum_records(self):
        force, speed = drum_force(), [10.0 + 0.0625 * (i % 2) for i in range(SAMPLES)]
        (self.folder / "drum.csv").write_text(
            "time [s],speed [m/s],Fz [N]\n" + "".join(f"{i * STEP!r},{v!r},{f!r}\n" for i, (v, f) in enumerate(zip(speed, force))))
        channel = lambda group, name, unit, count, step=STEP: (  # noqa: E731
            f"/'{group}'/'{name}'", (10, count), {"wf_increment": step, "unit_string": unit})
        pack = lambda values: tdms_files.pack("<", 10, values)  # noqa: E731
        flags = DESCRIBES | NEW_LIST | HAS_DATA
        (self.folder / "drum.tdms").write_bytes(tdms_files.segment(
            [channel("rig", "speed", "m/s", SAMPLES), channel("rig", "Fz", "N", SAMPLES)], pack(speed) + pack(force), flags))
        (self.folder / "two_rates.tdms").write_bytes(tdms_files.segment(
            [channel("drum", "speed", "m/s", SAMPLES // 10, 10 * STEP), channel("hub", "Fz", "N", SAMPLES)],
            pack([10.0] * (SAMPLES // 10)) + pack(force), flags))
        columns = [[int(16 * v) for v in speed], [int(8 * f) for f in force]]
        data, frames = rpc_files.history(columns, "h", "<", 256, 2048)
        records = dict(FORMAT="BINARY", FILE_TYPE="TIME_HISTORY", DATA_TYPE="SHORT_INTEGER", DELTA_T="5.000000E-04",
                       PTS_PER_FRAME=256, CHANNELS=2, PTS_PER_GROUP=2048, FRAMES=frames)
        for i, (name, unit, scale) in enumerate((("speed", "m/s", "6.25E-02"), ("Fz", "N", "0.125"))):
            records |= {f"DESC.CHAN_{i + 1}": name, f"UNITS.CHAN_{i + 1}": unit, f"SCALE.CHAN_{i + 1}": scale}
        (self.folder / "drum.rsp").write_bytes(rpc_files.header(records) + data)

    def average(self, file, keys="", code=DONE):
        """Returns what `latsch process` says of a recording, and the table of its average."""
        name = file.replace(".", "_") + str(len(keys))
        (self.folder / f"{name}.toml").write_text(RIG.format(file=file, keys=keys))
        text = self.latsch("process", self.folder / f"{name}.toml", code=code)
        tables = list((self.folder / f"{name}_processed").glob("average*.csv"))
        return text, tables[0].read_text() if tables else ""

    def assert_period(self, said):
        """The period is that of the turning drum to a fifth of a sample."""
        self.assertAlmostEqual(float(re.search(r"tire 36 km/h ([0-9.]+) ", said)[1]), 800.0, delta=0.1)

    def test_process_turns_recorders_files_into_the_average_of_the_same_numbers_in_a_table(self):
        self.write_drum_records()
        said, table = self.average("drum.csv")
        self.assert_period(said)
        rows = [row for row in csv.DictReader(line for line in table.splitlines() if not line.startswith("#"))]
        force = [float(row["Fz [N]"]) for row in rows]
        self.assertAlmostEqual(max(force), 1800.0, delta=0.2)  # the top of the hit
        self.assertAlmostEqual(min(force), 1000.0, delta=0.2)
        strip = lambda text: [line for line in text.splitlines() if not line.startswith("#")]  # noqa: E731
        for file in ("drum.tdms", "drum.rsp"):
            self.assertEqual(strip(self.average(file)[1]), strip(table), file)

    def test_process_joins_groups_and_says_which_one_it_took(self):
        self.write_drum_records()
        said, joined = self.average("two_rates.tdms", 'resample = "0.5 ms"')
        self.assert_period(said)
        self.assertTrue(joined)
        said, _ = self.average("two_rates.tdms", code=WRONG_INPUT)
        self.assertIn('expected group = one of "drum" or "hub" in [channels]', said)
        said, _ = self.average("two_rates.tdms", 'group = "hub"', code=WRONG_INPUT)
        self.assertIn("speed", said)
        said, _ = self.average("two_rates.tdms", 'resample = "1 ns"', code=WRONG_INPUT)
        self.assertIn('(unit "ns", which is not known; with capitals, "Ns", it is N s)', said)
        said, _ = self.average("two_rates.tdms", 'resample = "0.001 us"', code=WRONG_INPUT)
        self.assertIn('expected a larger step, such as 0.0005 s, the one of group "hub"', said)
        whole = (self.folder / "drum.tdms").read_bytes()
        (self.folder / "cut.tdms").write_bytes(whole[:-1000])  # its only chunk is cut
        self.assertIn("has no channel of numbers: the file is cut off", self.average("cut.tdms", code=WRONG_INPUT)[0])
        cut = (self.folder / "drum.rsp").read_bytes()[:-100]
        (self.folder / "cut_drum.rsp").write_bytes(cut)
        self.assertIn("cut off: it has 7 of 8 groups", self.average("cut_drum.rsp")[0])

    def test_show_names_a_channel_that_is_left_out_once(self):
        text = self.latsch("show", self.folder / "groups.tdms")
        head, ledger = text.split("Ledger of groups.tdms")
        self.assertEqual(head.count("it has time stamps"), 1, head)
        self.assertEqual(ledger.count("it has time stamps"), 1, ledger)
        self.assertIn("MoTeC log (experimental)", self.latsch("show", self.folder / "log.ld"))

    def test_a_message_shows_few_bytes_of_a_file_and_no_raw_ones(self):
        (self.folder / "wrong.uff").write_bytes(bytes(range(128, 256)) * 8)
        run = subprocess.run([LATSCH, "show", self.folder / "wrong.uff"], capture_output=True, timeout=300)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertTrue((run.stdout + run.stderr).isascii(), run.stderr)
        self.assertIn(b'is "' + b"." * 20 + b'...", expected "    -1"', run.stderr)

    def test_resampling_a_table_of_one_time_is_refused(self):
        (self.folder / "one.csv").write_text("time [s],Fz [N]\n0,1\n1,2\n")
        study = self.folder / "one.toml"
        study.write_text('[measurement.logged]\nfile = "one.csv"\nresample = "1 ms"\n[experiment]\n')
        text = self.latsch("show", study, "--measurement", "logged", code=WRONG_INPUT)
        self.assertIn("has one time for all channels, but resample is stated", text)


if __name__ == "__main__":
    unittest.main()
