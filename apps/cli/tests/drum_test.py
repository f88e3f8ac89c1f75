#!/usr/bin/env python3
"""Tests the way from the raw record of a drum to a fitted ring without a script: `latsch process` averages the
passages, a [measurement.NAME] reads the average, and a study fits the ring to its spectra.

The record is the response of a ring to a cleat, repeated as the drum turns, with noise and a run-up; the angle of the
cleat on the drum is not stated. The fit must find the sidewall parameters with which the record was computed.

   drum_test.py PATH/TO/latsch"""
import bisect
import csv
import json
import math
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT, assert_identifiability

RINGS = pathlib.Path(__file__).resolve().parents[3] / "studies/ring_tires"
STIFFNESS, DAMPING = 0.55, 55.0  # MN/m^2 and N s/m^2, sidewall of the shipped ring
SPEED, DRUM = 40.0 / 3.6, 2.5    # m/s, m
TEETH, RATE = 120, 2000          # Hz

CLEAT = """kind = "drum_cleat"
speed = "40 km/h"
load = "4 kN"
drum_diameter = "2.5 m"
duration = "0.3 s"
sample_step = "1 ms"
cleat = {height = "10 mm", length = "20 mm"}
"""

RIG = f"""[channels]
pulses = "tooth"
force = "Fz"
also = ["Fx"]
[drum]
circumference = "{math.pi * DRUM} m"
teeth = {TEETH}
[plateaus]
speeds = ["40 km/h"]
[run.tire]
file = "raw.csv"
"""

STUDY = """model = "tire.toml"

[measurement.passage]
file = "rig_processed/average_tire_40kph.csv"
shift = "-179 ms"                     # its hit onto that of the test, as well as one sees it
select = {time = "-40 ms .. 200 ms"}

[test.cleat]
""" + CLEAT + """
[variable.stiffness]
path = "sidewall.radial.stiffness"
lower = "0.3 MN/m^2"
upper = "1 MN/m^2"
initial = "0.7 MN/m^2"
[variable.damping]
path = "sidewall.radial.damping"
lower = "10 N s/m^2"
upper = "200 N s/m^2"
initial = "100 N s/m^2"

[experiment.Fz]
kind = "curve"
x = "cleat/time"
y = "cleat/Fz"
measurement = "passage"
compare = "psd"
[experiment.Fx]
kind = "curve"
x = "cleat/time"
y = "cleat/Fx"
measurement = "passage"
compare = "psd"

[run]
workers = 2
"""


def between(x, xs, ys):
    k = min(max(bisect.bisect(xs, x) - 1, 0), len(xs) - 2)
    return ys[k] + (ys[k + 1] - ys[k]) * (x - xs[k]) / (xs[k + 1] - xs[k])


class Drum(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_drum_"))
        shutil.copy(RINGS / "passenger_205_55R16.toml", cls.folder / "tire.toml")
        (cls.folder / "cleat.toml").write_text(CLEAT)
        (cls.folder / "rig.toml").write_text(RIG)
        (cls.folder / "study.toml").write_text(STUDY)
        cls.record()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def latsch(cls, *arguments):
        return subprocess.run([LATSCH, *arguments], cwd=cls.folder, capture_output=True, text=True)

    @classmethod
    def record(cls):
        """Writes a record of 20 s at a constant speed after a run-up of 2 s, with noise of 15 N
        and a voltage for the teeth."""
        cls.latsch("test", "tire.toml", "cleat.toml", "--output", "passage.csv")
        with open(cls.folder / "passage.csv") as file:
            rows = list(csv.DictReader(file))
        time = [float(row["time [s]"]) for row in rows]
        forces = [[float(row[name]) for row in rows] for name in ("Fz [N]", "Fx [N]")]
        turn = math.pi * DRUM / SPEED
        time.append(time[0] + turn)
        for force in forces:
            force.append(force[0])
        chance, way = random.Random(1), 0.0
        with open(cls.folder / "raw.csv", "w") as out:
            out.write("time [s],tooth [V],Fz [N],Fx [N]\n")
            for i in range(22 * RATE):
                way += SPEED * min(1.0, i / RATE / 2.0) / RATE
                at = time[0] + (way / SPEED - 0.31) % turn
                tooth = 2.5 + 2.0 * math.sin(2 * math.pi * way * TEETH / (math.pi * DRUM))
                Fz, Fx = (between(at, time, force) + chance.gauss(0, 15) for force in forces)
                out.write(f"{i / RATE:.4f},{tooth:.3f},{Fz:.2f},{Fx:.2f}\n")

    def test_a_raw_record_becomes_a_fitted_ring(self):
        processed = self.latsch("process", "rig.toml")
        self.assertEqual(processed.returncode, DONE, processed.stderr)
        ran = self.latsch("run", "study.toml", "--json")
        self.assertEqual(ran.returncode, DONE, ran.stderr)
        variables = json.loads(ran.stdout)["result"]["variables"]
        found = {variable["name"]: variable["value"] for variable in variables}
        self.assertAlmostEqual(found["stiffness"] / STIFFNESS, 1.0, delta=0.01)
        self.assertAlmostEqual(found["damping"] / DAMPING, 1.0, delta=0.05)

    def test_what_a_processed_table_holds_is_shown(self):
        self.assertEqual(self.latsch("process", "rig.toml").returncode, DONE)
        shown = self.latsch("show", "study.toml", "--measurement", "passage")
        self.assertEqual(shown.returncode, DONE, shown.stderr)
        self.assertIn("time shifted by -0.179 s", shown.stdout)

    def new(self, folder, *arguments):
        shutil.rmtree(self.folder / folder, ignore_errors=True)
        return self.latsch("new", folder, "--drum", *arguments)

    def test_one_command_makes_a_study_of_a_raw_record(self):
        """Checks a record of a toothed wheel instead of a speed: the page of the rig, the averages, and a study that
        identifies the sidewall and the delays of the record."""
        wrote = self.new("from_raw", "raw.csv", "--cleat", "10 mm x 20 mm", "--drum-diameter", f"{DRUM} m",
                         "--teeth", str(TEETH))
        self.assertEqual(wrote.returncode, DONE, wrote.stderr)
        self.assertIn("passages at 40 km/h, load 4", wrote.stdout)
        ran = self.latsch("run", "from_raw/study.toml", "--json")
        self.assertEqual(ran.returncode, DONE, ran.stderr)
        result = json.loads(ran.stdout)["result"]
        found = {variable["name"]: variable for variable in result["variables"]}
        self.assertAlmostEqual(found["radial"]["value"] / STIFFNESS, 1.0, delta=0.01)
        self.assertAlmostEqual(found["radial_damping"]["value"] / DAMPING, 1.0, delta=0.05)
        for delay in result["delays"]:
            self.assertFalse(delay["at_end"], delay)
            self.assertLess(delay["upper"] - delay["lower"], 2e-3, delay)
        assert_identifiability(self, self.folder / "from_raw", [one["name"] for one in result["variables"]])
        told = self.latsch("run", "from_raw/study.toml")
        self.assertRegex(told.stdout, r"Delay of raw_40kph_Fz: -?[0-9.]+ ms, 95 %: -?[0-9.]+ .. -?[0-9.]+ ms")

    def test_the_drum_follows_from_speed_and_period(self):
        """Checks a record with a speed in km/h and forces in SAE signs: the program finds and
        reports the diameter and the axes."""
        with open(self.folder / "raw.csv") as raw, open(self.folder / "speed.csv", "w") as out:
            next(raw)
            out.write("ET [s],V [km/h],FZ [N],FX [N]\n")
            for line in raw:
                time, _, Fz, Fx = line.strip().split(",")
                speed = 3.6 * SPEED * min(1.0, float(time) / 2.0)
                out.write(f"{time},{speed:.4f},{-float(Fz):.2f},{Fx}\n")
        wrote = self.new("from_speed", "speed.csv", "--cleat", "10 mm x 20 mm")
        self.assertEqual(wrote.returncode, DONE, wrote.stderr)
        self.assertIn("drum diameter 2.5 m, by the speed and the period", wrote.stdout)
        self.assertIn('axes = "sae"', wrote.stdout)
        checked = self.latsch("check", "from_speed/study.toml")
        self.assertEqual(checked.returncode, DONE, checked.stdout + checked.stderr)

    def test_a_channel_that_is_not_needed_may_be_left_out(self):
        """Checks a record with a column of an unknown unit: a study is written without it, and a needed one is refused
        by its reason."""
        for name, head in (("beside", "time [s],tooth [V],Fz [N],Fx [N],temp [grC]"),
                           ("needed", "time [s],tooth [V],Fz [Nn],Fx [N],temp [degC]")):
            with open(self.folder / "raw.csv") as raw, open(self.folder / f"{name}.csv", "w") as out:
                next(raw)
                out.write(head + "\n")
                for line in raw:
                    out.write(line.strip() + ",21.5\n")
        stated = ("--cleat", "10 mm x 20 mm", "--drum-diameter", f"{DRUM} m", "--teeth", str(TEETH))
        wrote = self.new("from_beside", "beside.csv", *stated)
        self.assertEqual(wrote.returncode, DONE, wrote.stderr)
        self.assertIn('"temp" of beside.csv is left out, which a drum does not need', wrote.stdout + wrote.stderr)
        refused = self.new("from_needed", "needed.csv", *stated)
        self.assertEqual(refused.returncode, WRONG_INPUT, refused.stdout)
        self.assertIn('unknown unit "Nn"', refused.stderr)
        self.assertIn("correct the unit in the file", refused.stderr)
        self.assertFalse((self.folder / "from_needed").exists())

    def test_what_a_drum_needs_is_asked_for(self):
        raw = ["raw.csv", "--cleat", "10 mm x 20 mm"]
        for arguments, part in [
            (["raw.csv"], "no recording contains the cleat's size"),
            (raw, "no column that is speed"),
            (raw + ["--teeth", "120"], "--drum-diameter"),
            (["raw.csv", "--cleat", "10 mm"], "such as \"10 mm x 20 mm\""),
            (raw + ["--column", "Fz = LOAD"], "has no column \"LOAD\""),
            (raw + ["--column", "speed = Fz"], "not a unit of the speed of a drum"),
        ]:
            refused = self.new("refused", *arguments)
            self.assertEqual(refused.returncode, WRONG_INPUT, (arguments, refused.stdout))
            self.assertIn(part, refused.stderr)

    def test_a_speed_of_another_sign_or_kind_is_refused_by_its_reason(self):
        with open(self.folder / "raw.csv") as raw:
            rows = list(csv.reader(raw))[1:]
        times = [float(row[0]) for row in rows]
        for name, header, speed, parts in [
            ("backward", "speed [m/s]", lambda t: -SPEED, ["turns backward", "with the other sign"]),
            ("still", "speed [m/s]", lambda t: 0.0, ["stands still"]),
            ("rpm", "drum speed [rpm]", lambda t: SPEED / DRUM * 2 * 60 / (2 * math.pi),
             ['"drum speed", in SI in rad/s', "rate times pi times diameter"]),
            ("hertz", "Drum-Speed [Hz]", lambda t: SPEED / DRUM / math.pi,
             ['"Drum-Speed", in SI in Hz', "rate times pi times diameter"]),
        ]:
            with open(self.folder / f"{name}.csv", "w") as out:
                out.write(f"time [s],{header},Fz [N],Fx [N]\n")
                out.writelines(f"{t},{speed(t):.6f},4000,0\n" for t in times)
            refused = self.new("refused", f"{name}.csv", "--cleat", "10 mm x 20 mm")
            self.assertEqual(refused.returncode, WRONG_INPUT, (name, refused.stdout))
            for part in parts:
                self.assertIn(part, refused.stderr)

    def test_a_window_that_leaves_nothing_is_said(self):
        self.assertEqual(self.latsch("process", "rig.toml").returncode, DONE)
        text = STUDY.replace('shift = "-179 ms"', 'shift = "3 s"')
        (self.folder / "late.toml").write_text(text)
        checked = self.latsch("check", "late.toml")
        self.assertEqual(checked.returncode, WRONG_INPUT)
        self.assertIn("-40 ms .. 200 ms", checked.stderr)


if __name__ == "__main__":
    unittest.main()
