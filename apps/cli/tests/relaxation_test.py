#!/usr/bin/env python3
"""Tests whether a recorded sweep determines the relaxation length of the side force: if the force lags, the study
fits it; otherwise a message says that it does not lag.

The lag of the record is integrated here (Runge-Kutta of order 4, a hundred steps for each sample). The forces at the
lagged slip angles are the program's steady states, which tests of models/magic_formula compare with published tables.

   relaxation_test.py PATH/TO/latsch"""
import csv
import json
import math
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH

CARCASS = 140e3  # N/m, LATERAL_STIFFNESS
SPEED = 40 / 3.6  # m/s
PERIOD, STEP, MOST = 8.0, 0.05, 10.0  # s, s, deg: about 8 deg/s near zero slip angle
LOADS = (600, 1600, 2600)  # N
TIR = f"""[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
PRESSURE = 'pascal'
[MODEL]
FITTYP = 61
LONGVL = {SPEED}
[DIMENSION]
UNLOADED_RADIUS = 0.2032
[VERTICAL]
FNOMIN = 1600
VERTICAL_STIFFNESS = 218000
[STRUCTURAL]
LATERAL_STIFFNESS = {CARCASS}
[COEFFICIENTS]
PCY1 = 1.5
PDY1 = 1.25
PDY2 = -0.12
PEY1 = -0.8
PEY2 = -0.3
PKY1 = -32
PKY2 = 1.9
PHY1 = 0.002
PVY1 = 0.02
"""


def tangent(t):
    return math.tan(math.radians(MOST) * math.sin(2 * math.pi * t / PERIOD))


def lagged_tangents(sigma, count):
    """Integrates the differential equation sigma dy/dt + V y = V tan alpha of the lagging slip y, from the steady
    state y = tan alpha."""
    def rate(t, y):
        return SPEED / sigma * (tangent(t) - y)

    parts = 100
    h, y, found = STEP / parts, tangent(0.0), []
    for i in range(count):
        found.append(y)
        for part in range(parts):
            t = STEP * i + h * part
            a = rate(t, y)
            b = rate(t + h / 2, y + h / 2 * a)
            c = rate(t + h / 2, y + h / 2 * b)
            d = rate(t + h, y + h * c)
            y += h / 6 * (a + 2 * b + 2 * c + d)
    return found


class Relaxation(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_relaxation_"))
        self.addCleanup(shutil.rmtree, self.base)
        (self.base / "truth.tir").write_text(TIR)

    def latsch(self, *arguments):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, DONE, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout

    def answers(self, rows):
        """Returns the steady-state side forces for rows of (Fz, tan alpha)."""
        (self.base / "states.csv").write_text(
            "Fz [N],alpha [rad]\n" + "".join(f"{Fz},{math.atan(y)!r}\n" for Fz, y in rows))
        self.latsch("test", self.base / "truth.tir",
                    f'{{kind = "steady_states", states = "{self.base / "states.csv"}"}}', "-o", self.base / "out.csv",
                    "--quiet")
        with open(self.base / "out.csv") as file:
            table = list(csv.reader(line for line in file if not line.startswith("#")))
        names = [cell.split(" ")[0] for cell in table[0]]
        return [dict(zip(names, map(float, row))) for row in table[1:]]

    def record(self, name, lags, seed):
        """Writes two periods of the sweep for each load with a pause between the loads; the noise is 0.5 % of the
        largest force."""
        count = round(2 * PERIOD / STEP)
        chance, rows, lines = random.Random(seed), [], []
        for Fz in LOADS:
            if lags:
                sigma = abs(self.answers([(Fz, 0.0)])[0]["Kya"]) / CARCASS
                rows += [(Fz, y) for y in lagged_tangents(sigma, count)]
            else:
                rows += [(Fz, tangent(STEP * i)) for i in range(count)]
        forces = [answer["Fy"] for answer in self.answers(rows)]
        noise = 0.005 * max(map(abs, forces))
        for k, (Fz, Fy) in enumerate(zip((Fz for Fz, _ in rows), forces)):
            t = STEP * (k % count)
            lines.append(f"{60 * (k // count) + t:.6f},{math.degrees(math.atan(tangent(t)))!r},{Fz},"
                         f"{Fy + chance.gauss(0, noise)!r},{20.32 - 100 * Fz / 218e3!r},40\n")
        (self.base / name).write_text("ET [s],SA [deg],FZ [N],FY [N],RL [cm],V [km/h]\n" + "".join(lines))
        return self.base / name

    def test_the_lag_of_a_record_gives_the_carcass_back(self):
        record = self.record("lagging.csv", True, 1)
        folder = self.base / "lagging"
        self.latsch("new", folder, "--magic-formula", record)
        study = (folder / "study.toml").read_text()
        self.assertRegex(study, r"# Fy lags behind the slip by 0\.\d+ \+- 0\.\d+ m .*: its relaxation length is fitted")
        self.assertIn('kind = "slip_history"', study)
        self.assertIn("stage.relaxation_y", study)
        run = json.loads(self.latsch("run", folder / "study.toml", "--json"))
        found = {v["name"]: v["interval"] for v in run["result"]["variables"]}
        lower, upper = found["LATERAL_STIFFNESS"]
        self.assertTrue(lower < CARCASS < upper, (lower, upper))
        self.assertLess(upper - lower, 0.2 * CARCASS)

    def test_a_record_without_lag_gets_no_such_stage(self):
        record = self.record("steady.csv", False, 2)
        folder = self.base / "steady"
        self.latsch("new", folder, "--magic-formula", record)
        study = (folder / "study.toml").read_text()
        self.assertRegex(study, r"# Fy lags behind the slip by -?0\.0\d+ \+- 0\.\d+ m .*: states count as steady")
        for word in ("slip_history", "relaxation", "LATERAL_STIFFNESS"):
            self.assertNotIn(word, study)

    def test_its_slopes_are_those_of_its_values(self):
        folder = self.base / "slopes"
        self.latsch("new", folder, "--magic-formula", self.record("lagging.csv", True, 3))
        self.assertIn("All of them agree", self.latsch("check", folder / "study.toml", "--derivatives"))


if __name__ == "__main__":
    unittest.main()
