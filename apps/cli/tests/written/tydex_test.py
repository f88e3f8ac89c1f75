#!/usr/bin/env python3
"""Tests TYDEX files that `latsch test` and `latsch process` write, with a reader that cuts lines at the columns of the
format and shares no code with the program.

   tydex_test.py PATH/TO/latsch"""
import csv
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, WRONG_INPUT

STUDIES = pathlib.Path(__file__).resolve().parents[4] / "studies"
RING = STUDIES / "ring_tires" / "passenger_205_55R16.toml"
FORMULA = STUDIES / "tire_model_comparison" / "magic_formula.tir"
SWEEP = '{kind = "slip_sweep", load = "4 kN", speed = "30 km/h", alpha = ["-6 deg", "6 deg"], duration = "0.4 s"%s}'
UNITS = {"s": 1.0, "m": 1.0, "m/s": 1.0, "N": 1.0, "Nm": 1.0, "-": 1.0, "deg": math.pi / 180.0, "Pa": 1.0, "rad/s": 1.0, "N/rad": 1.0,
         "N/m": 1.0, "1/m": 1.0}


def tydex(file, by_columns=True):
    """Returns the channels in SI by their names, the entries of header and constants, and the comments."""
    channels, entries, comments, section = {}, {}, [], None
    for line in file.read_text().splitlines():
        if line.startswith("**"):
            section = line
        elif line.startswith("!"):
            comments.append(line[2:])
        elif section in ("**HEADER", "**CONSTANTS"):
            entries[line[:10].strip()] = line[50:].strip()
        elif section == "**MEASURCHANNELS":
            name, unit = line[:10].strip(), line[40:50].strip()
            assert [float(line[50 + 10 * i:60 + 10 * i]) for i in range(3)] == [1.0, 0.0, 0.0], line
            channels[name] = (UNITS[unit], [])
        elif section == "**MEASURDATA":
            cells = [line[10 * i:10 * i + 10] for i in range(len(channels))] if by_columns else line.split()
            assert len(cells) == len(channels), line
            for (factor, values), cell in zip(channels.values(), cells):
                values.append(factor * float(cell))
    assert section == "**END"
    return {name: values for name, (_, values) in channels.items()}, entries, comments


class Tydex(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_tydex_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, timeout=300,
                             env={**os.environ, "SOURCE_DATE_EPOCH": "86400"})
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def table(self, name):
        with open(self.folder / name, newline="") as file:
            rows = [row for row in csv.reader(file) if not row[0].startswith("#")]
        return {title.split(" [")[0]: [float(row[i]) for row in rows[1:]] for i, title in enumerate(rows[0])}

    def test_a_virtual_test_is_read_by_its_columns(self):
        names = {"RUNTIME": "time", "SLIPANGL": "alpha", "LONGSLIP": "kappa", "FX": "Fx", "FYW": "Fy", "FZW": "Fz",
                 "MXW": "Mx", "MYW": "My", "MZW": "Mz", "RL": "loaded_radius"}
        for model in (RING, FORMULA):
            self.latsch("test", model, SWEEP % "", "-o", "sweep.csv")
            said = self.latsch("test", model, SWEEP % "", "-o", "sweep.tdx")
            expected = self.table("sweep.csv")
            # Nine characters hold seven digits beside sign and point, six behind "-0.": half a unit of the last one.
            for file, by_columns, within in (("sweep.tdx", True, 5e-7), ("all.tdx", False, 1e-15)):
                if not by_columns:
                    self.latsch("test", model, SWEEP % "", "-o", "all.tdx", "--all-digits")
                found, entries, comments = tydex(self.folder / file, by_columns)
                self.assertEqual({name: names[name] for name in found}, names)
                for name, values in found.items():
                    largest = max(map(abs, expected[names[name]]))
                    for value, of_table in zip(values, expected[names[name]], strict=True):
                        self.assertAlmostEqual(value, of_table, delta=within * max(largest, 1.0), msg=name)
            self.assertGreater(found["FYW"][0], 500.0)  # a negative slip angle makes a positive side force: ISO
            self.assertLess(found["SLIPANGL"][0], 0.0)
            self.assertEqual(entries["RELEASE"], "1.3")
            self.assertEqual(entries["DATE"], "1970-01-02")
            self.assertTrue(any("no measurement" in line for line in comments), comments)
            self.assertIn("axes W, signs of ISO 8855", said)
            self.assertIn("loaded_radius RL", said)

    def test_names_state_the_frames_that_the_test_states(self):
        self.latsch("test", FORMULA, SWEEP % ', camber = "3 deg", frame = ["C", "W"]', "-o", "frames.tdx")
        found, _, _ = tydex(self.folder / "frames.tdx")
        self.assertLessEqual({"FXC", "FYC", "FZC", "MXC", "FX", "FYW", "FZW", "MXW"}, set(found))
        # C is W turned about x by the camber: F_C = A' F_W (measurement/axes.h).
        sine, cosine = math.sin(math.radians(3.0)), math.cos(math.radians(3.0))
        for fy, fz, in_c in zip(found["FYW"], found["FZW"], found["FYC"]):
            self.assertAlmostEqual(in_c, cosine * fy + sine * fz, delta=0.02)

    def test_the_program_shows_and_reads_what_it_wrote(self):
        self.latsch("test", RING, SWEEP % "", "-o", "sweep.tdx")
        shown = self.latsch("show", "sweep.tdx")
        self.assertRegex(shown, r"FYW +N +W")
        self.assertIn("Computed by Latsch", shown)

    def test_averages_of_a_rig_state_the_frame_that_was_given(self):
        shutil.copy(STUDIES / "drum_processing" / "rig.toml", self.folder)
        said = self.latsch("process", "rig.toml", "--synthetic", "--tydex", "H")
        files = sorted((self.folder / "rig_processed").glob("average_*.tdx"))
        self.assertEqual(len(files), len(list((self.folder / "rig_processed").glob("average_*.csv"))))
        for file in files[:2]:
            found, entries, _ = tydex(file)
            expected = self.table(file.with_suffix(".csv"))
            self.assertEqual(list(found), ["RUNTIME", "FZH", "FZSPREAD", "FXH", "FXSPREAD"])
            for name, of_table in (("FZH", "Fz"), ("FXSPREAD", "Fx_spread")):
                for value, other in zip(found[name], expected[of_table], strict=True):
                    self.assertAlmostEqual(value, other, delta=5e-4)
            self.assertAlmostEqual(float(entries["TRAJVELW"]), float(file.stem.split("_")[-1].removesuffix("kph")) / 3.6,
                                   delta=1e-6)
        self.assertEqual(said.count("are in axes H"), 1)
        for file in self.folder.glob("*_*.csv"):  # the runs, not the hammer
            head, *lines = file.read_text().splitlines()
            names = head.split(",")
            where = [k for k, name in enumerate(names) if name.startswith("Fz")]
            rows = [line.split(",") for line in lines]
            for k in where:
                for row in rows:
                    row[k] = str(-float(row[k]))
            file.write_text("\n".join([head] + [",".join(row) for row in rows]) + "\n")
        self.assertIn("are not those of ISO 8855", self.latsch("process", "rig.toml", "--tydex", "H", code=WRONG_INPUT))
        self.assertIn("not in {W,H,C}", self.latsch("process", "rig.toml", "--tydex", "X", code=WRONG_INPUT))

    def test_what_does_not_fit_is_refused(self):
        for more, part in ((("-o", "x.csv", "--all-digits"), "only a TYDEX file"), (("--all-digits",), "only a TYDEX file"),
                           (("-o", "none/x.tdx"), "none/x.tdx")):
            self.assertIn(part, self.latsch("test", FORMULA, SWEEP % "", *more, code=WRONG_INPUT))
        corner = STUDIES / "compliance" / "corner.toml"
        self.assertIn("signs of ISO 8855", self.latsch("test", corner, '{kind = "kc", Fz = "1 kN"}', "--signs", "sae", "-o",
                                                       "x.tdx", code=WRONG_INPUT))
        self.assertIn("defines a name for no channel", self.latsch("test", RING, '{kind = "modes"}', "-o", "x.tdx", code=WRONG_INPUT))
        self.assertIn("writes CSV or TYDEX", self.latsch("test", RING, '{kind = "modes"}', "-o", "x.XLSX", code=WRONG_INPUT))
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_states_of_a_table_stand_beside_their_forces(self):
        (self.folder / "states.csv").write_text("Fz [kN],alpha [deg],p [bar]\n4,2,2.2\n4,-1.5,2.2\n3,1,2.4\n")
        self.latsch("test", FORMULA, '{kind = "steady_states", states = "states.csv"}', "-o", "x.tdx")
        found, _, _ = tydex(self.folder / "x.tdx")
        for name, expected in (("SLIPANGL", [math.radians(a) for a in (2, -1.5, 1)]), ("INFLPRES", [2.2e5, 2.2e5, 2.4e5]),
                               ("FZW", [4000, 4000, 3000])):
            for value, right in zip(found[name], expected, strict=True):
                self.assertAlmostEqual(value, right, delta=1e-6 * abs(right))
        self.assertLess(found["FYW"][0] * found["FYW"][1], 0)


if __name__ == "__main__":
    unittest.main()
