#!/usr/bin/env python3
"""Tests the way from raw recordings of cornering and driving to a .tir with intervals: `latsch new --magic-formula`,
run, export.

The recordings are forces that the program computes for a tire with known coefficients (models/magic_formula is
compared with published tables), with noise, in SAE signs and the units of a tire test consortium.

   magic_formula_test.py PATH/TO/latsch"""
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

TRUTH = {"PCY1": 1.5, "PDY1": 1.25, "PEY1": -0.8, "PKY1": -32.0, "PDY2": -0.12, "PKY2": 1.9, "PEY2": -0.3,
         "PDY3": 5.0, "PKY6": -1.2, "PPY1": 0.4, "PPY3": -0.3, "PHY1": 0.002, "PVY1": 0.02,
         "PCX1": 1.55, "PDX1": 1.35, "PEX1": -0.3, "PKX1": 35.0, "PDX2": -0.1, "PKX2": 1.0,
         "RBX1": 12.0, "RBX2": 9.0, "RCX1": 1.05, "RBY1": 11.0, "RBY2": 7.0, "RCY1": 1.02,
         "QBZ1": 9.0, "QCZ1": 1.15, "QDZ1": 0.11, "QEZ1": -1.5, "QDZ2": -0.02, "QDZ8": 0.3}

TIR = """[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
PRESSURE = 'pascal'
[MODEL]
FITTYP = 61
LONGVL = 11.11
[DIMENSION]
UNLOADED_RADIUS = 0.2032
[OPERATING_CONDITIONS]
INFLPRES = 83000
NOMPRES = 83000
[VERTICAL]
FNOMIN = 1600
VERTICAL_STIFFNESS = 218000
[COEFFICIENTS]
"""

PRESSED = """title = "pressed"
model = "tire.tir"
test.ground = {{kind = {0}}}
[variable.stiffness]
path = "VERTICAL_STIFFNESS"
lower = "50 N/mm"
upper = "600 N/mm"
initial = "150 N/mm"
[experiment.force]
kind = "values"
channel = "ground/{1}"
values = {{unit = "{2}", values = [{3}]}}
exponent = 2
[optimizer]
method = "auto"
[run]
workers = 1
intervals = false
"""


def sweep(most, count):
    """Returns the values of a sweep up and down, as on a rig; both extreme values occur twice."""
    return [most * math.sin(2 * math.pi * i / count) for i in range(count)]


class MagicFormula(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_mf_"))
        (cls.base / "truth.tir").write_text(TIR + "".join(f"{k} = {v}\n" for k, v in TRUTH.items()))
        cornering, driving = [], []
        for p in (69, 83, 97):
            for gamma in (0, 3):
                for Fz in (500, 1600, 2600):
                    cornering += [(Fz, 0.0, a, gamma, p) for a in sweep(12.0, 21)]
        for Fz in (500, 1600, 2600):
            for alpha in (0, 3, 6):
                driving += [(Fz, k, alpha, 0, 83) for k in sweep(0.2, 25)]
        cls.record("cornering.dat", cornering, 1)
        cls.record("driving.dat", driving, 2)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.base)

    @classmethod
    def record(cls, name, states, seed):
        """Writes a recording with noise of 0.5 % of the largest force and moment, in km/h, deg,
        kPa, N, with SAE signs."""
        table = cls.base / "states.csv"
        table.write_text("Fz [N],kappa,alpha [deg],gamma [deg],p [kPa],Vx [km/h]\n" +
                         "".join(f"{F},{k},{a},{g},{p},40\n" for F, k, a, g, p in states))
        (cls.base / "steady.toml").write_text('kind = "steady_states"\nstates = "states.csv"\n')
        subprocess.run([LATSCH, "test", cls.base / "truth.tir", cls.base / "steady.toml", "-o", cls.base / "truth.csv",
                        "--quiet"], check=True)
        with open(cls.base / "truth.csv") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        names = [cell.split(" ")[0] for cell in rows[0]]
        answers = [dict(zip(names, map(float, row))) for row in rows[1:]]
        chance = random.Random(seed)
        noise = {c: 0.005 * max(abs(a[c]) for a in answers) for c in ("Fx", "Fy", "Mz")}
        lines = ["Tire: a tire of known coefficients", "ET\tV\tSA\tIA\tSR\tP\tRL\tFX\tFY\tFZ\tMZ",
                 "sec\tkph\tdeg\tdeg\tnone\tkPa\tcm\tN\tN\tN\tN-m"]
        for i, ((F, k, a, g, p), answer) in enumerate(zip(states, answers)):
            measured = {c: answer[c] + chance.gauss(0, noise[c]) for c in noise}
            lines.append("\t".join(f"{x:.6g}" for x in (
                0.01 * i, 40, -a, g, k, p, 20.32 - 100 * F / 218e3, measured["Fx"], -measured["Fy"], -F,
                -measured["Mz"])))
        (cls.base / name).write_text("\n".join(lines) + "\n")

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run

    def test_raw_recordings_become_a_tire_with_intervals(self):
        folder = self.base / "fit"
        self.latsch("new", folder, "--magic-formula", self.base / "cornering.dat", self.base / "driving.dat")
        study = (folder / "study.toml").read_text()
        self.assertLessEqual(len([line for line in study.splitlines() if line and not line.startswith("#")]), 25)
        self.assertIn('axes = "sae"', study)  # the sign of Fz shows which axes it has
        tire = (folder / "tire.tir").read_text()
        for name, value in (("FNOMIN", 1600), ("NOMPRES", 83000)):  # these reference values define the coefficients
            self.assertRegex(tire, rf"{name} += {value}\b")
        run = json.loads(self.latsch("run", folder / "study.toml", "--json").stdout)
        found = {v["name"]: v["interval"] for v in run["result"]["variables"]}
        inside = told = 0
        for name in TRUTH.keys() & found.keys():
            lower, upper = found[name]
            inside += (lower is None or lower <= TRUTH[name]) and (upper is None or TRUTH[name] <= upper)
            told += 1
        self.assertGreaterEqual(told, 28)
        self.assertGreaterEqual(inside, 0.85 * told)  # 95 % each
        assert_identifiability(self, folder, found)
        self.latsch("export", folder / "study.toml", "--model", folder / "fitted.tir")
        self.latsch("test", folder / "fitted.tir", self.base / "steady.toml", "-o", folder / "fitted.csv", "--quiet")
        columns = {}
        for file in (self.base / "truth.csv", folder / "fitted.csv"):
            with open(file) as text:
                rows = list(csv.reader(line for line in text if not line.startswith("#")))
            at = [cell.split(" ")[0] for cell in rows[0]]
            columns[file.name] = {c: [float(row[at.index(c)]) for row in rows[1:]] for c in ("Fx", "Fy")}
        for c in ("Fx", "Fy"):
            true, fitted = columns["truth.csv"][c], columns["fitted.csv"][c]
            error = math.sqrt(sum((a - b) ** 2 for a, b in zip(true, fitted)) / sum(a * a for a in true))
            self.assertLess(error, 0.01, c)

    def test_what_rolls_tells_slopes_of_steady_states_alone(self):
        """Checks that a Magic Formula has derivatives with respect to its coefficients in every test except static
        ones."""
        for keys in (('"load_deflection", deflections = ["5 mm", "10 mm"]', "force", "N", "1000, 2000"),
                     ('"static_stiffness", load = "2 kN", directions = ["vertical"]', "vertical", "N/mm", "200")):
            folder = pathlib.Path(tempfile.mkdtemp(dir=self.base))
            (folder / "tire.tir").write_text(TIR + "".join(f"{k} = {v}\n" for k, v in TRUTH.items()))
            (folder / "study.toml").write_text(PRESSED.format(*keys))
            said = self.latsch("run", folder / "study.toml").stdout
            self.assertRegex(said, r"stiffness +(200|199\.9+\d*|200\.0\d*) N/mm", said)

    def test_what_does_not_vary_is_not_freed(self):
        folder = self.base / "cornering_alone"
        self.latsch("new", folder, "--magic-formula", self.base / "cornering.dat")
        study = (folder / "study.toml").read_text()
        self.assertIn("PPY1", study)
        self.assertNotIn("PCX1", study)
        self.assertNotIn("driving", study)
        self.latsch("check", folder / "study.toml")

    def test_levels_of_a_condition_are_those_of_the_samples_that_a_stage_fits(self):
        """Writes recordings with three pressures and two camber angles in cornering, and one of each in driving."""
        folder = self.base / "levels"
        said = self.latsch("new", folder, "--magic-formula", self.base / "cornering.dat", self.base / "driving.dat")
        study = (folder / "study.toml").read_text()
        vary = study[study.index("vary = "):].splitlines()[0]
        for told in ("PPY4", "PPZ1", "PDY3"):
            self.assertIn(f'"{told}"', vary)
        for untold in ("PPX1", "PPX4", "PDX3", "QBZ5"):
            self.assertNotIn(f'"{untold}"', vary)
            self.assertRegex(study, rf"# not freed, .*\b{untold}\b")
        self.assertIn("of order 1 in the pressure, of which there is 1 level: 83 kPa: PPX1", said.stdout)

    def test_check_warns_of_a_coefficient_with_too_few_levels(self):
        folder = self.base / "two"
        self.latsch("new", folder, "--magic-formula", self.base / "cornering.dat")
        text = (folder / "study.toml").read_text().replace(
            "measurement.cornering = {", 'measurement.cornering = {select = {p = "60 kPa .. 90 kPa"}, ')
        (folder / "study.toml").write_text(text)
        said = self.latsch("check", folder / "study.toml").stderr
        self.assertIn("PPY4 is of order 2 in the pressure, of which there are 2 levels: 69, 83 kPa", said)
        self.assertNotIn("PPY3 is of", said)

    def test_what_is_missing_is_said(self):
        without = self.base / "without.dat"
        without.write_text("run\nET\tSA\nsec\tdeg\n0\t1\n1\t2\n")
        run = self.latsch("new", self.base / "a", "--magic-formula", without, code=WRONG_INPUT)
        self.assertIn("no column is called Fz", run.stderr)
        rows = [f"{0.1 * i:g}\t{i % 12 - 6}\t-1000\t{-100 * (i % 12 - 6)}" for i in range(60)]
        without.write_text("run\nET\tSA\tFZ\tFY\nsec\tdeg\tN\tN\n" + "\n".join(rows) + "\n")
        run = self.latsch("new", self.base / "b", "--magic-formula", without, code=WRONG_INPUT)
        self.assertIn("--radius", run.stderr)
        self.latsch("new", self.base / "c", "--magic-formula", without, "--radius", "32 cm")
        run = self.latsch("new", self.base / "d", "--magic-formula", without, "--radius", "32 N", code=WRONG_INPUT)
        self.assertIn("expected a length", run.stderr)
        self.assertFalse((self.base / "d").exists())


if __name__ == "__main__":
    unittest.main()
