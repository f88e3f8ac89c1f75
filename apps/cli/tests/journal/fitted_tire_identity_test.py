#!/usr/bin/env python3
"""Tests that a tire fitted to a recording gives no file and no unit once the recording has been edited, until a search
has run on it.

   fitted_tire_identity_test.py PATH/TO/latsch"""
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cli_testing import DONE, LATSCH, WRONG_INPUT

TIRE = """
[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
PRESSURE = 'pascal'
[MODEL]
FITTYP = 61
TYRESIDE = 'LEFT'
LONGVL = 11.11
[DIMENSION]
UNLOADED_RADIUS = 0.198
[OPERATING_CONDITIONS]
INFLPRES = 83000
NOMPRES = 83000
[VERTICAL]
FNOMIN = 1100
VERTICAL_STIFFNESS = 200000
[STRUCTURAL]
LONGITUDINAL_STIFFNESS = 200000
LATERAL_STIFFNESS = 100000
[CONTACT_PATCH]
Q_RA1 = 0.5
Q_RB1 = 1
[LONGITUDINAL_COEFFICIENTS]
PCX1 = 1.5
PDX1 = 1
PEX1 = -0.5
PKX1 = 8
[LATERAL_COEFFICIENTS]
PCY1 = 1.4
PDY1 = 1.8
PEY1 = -0.5
PKY1 = -30
PKY2 = 1.6
[ALIGNING_COEFFICIENTS]
QBZ1 = 8
QCZ1 = 1.2
QDZ1 = 0.1
QEZ1 = -1
"""
FOREIGN = "no search has run on the study as it stands"
TIRE_STUDY = """
model = "tire.tir"
vary = ["PDY1", "PKY1"]
[measurement.m]
file = "iso.csv"
[test.steady]
kind = "steady_states"
states = {from = "measurement.m"}
[experiment.fy]
kind = "curve"
y = "steady/Fy"
measurement = "m"
"""


class FittedTire(unittest.TestCase):
    """Tests a .tir fitted to a recording whose force is edited afterwards. This changes no input of the test, so all
    trials stay valid."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_foreign_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.study = self.folder / "study.toml"
        self.study.write_text(TIRE_STUDY)
        (self.folder / "tire.tir").write_text(TIRE)
        self.record(2.1)

    def record(self, friction):
        rows = ["ET [s],SA [deg],IA [deg],FZ [N],FY [N],P [kPa]"]
        for load in (800, 1200):
            for step in range(33):
                angle = math.radians(0.5 * step - 8)
                force = -friction * load * math.sin(1.4 * math.atan(9 * angle))
                rows.append(f"{len(rows) / 10},{math.degrees(angle)},0,{load},{force},83")
        (self.folder / "iso.csv").write_text("\n".join(rows) + "\n")

    def run_it(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def value(self, file):
        return float(re.search(r"PDY1 *= *(\S+)", file.read_text()).group(1))

    def test_an_edited_recording_gives_no_tir_and_no_unit_before_a_search_has_run(self):
        tir, unit, page = self.folder / "fitted.tir", self.folder / "fitted.fmu", self.folder / "page.html"
        exports = [("export", self.study, "--model", tir), ("export", self.study, "--fmu", "2.0", "-o", unit),
                   ("report", self.study, "-o", page), ("test", self.study, '{kind = "static_stiffness", load = "1 kN", directions = ["vertical"]}')]
        self.run_it("run", self.study)
        for call in exports:
            self.run_it(*call)
        before = self.value(tir)
        for file in (tir, unit, page):
            file.unlink()
        self.record(1.5)
        for call in exports:
            self.assertIn(FOREIGN, self.run_it(*call, code=WRONG_INPUT))
        self.assertFalse(tir.exists() or unit.exists() or page.exists())
        self.run_it("run", self.study)
        self.run_it(*exports[0])
        self.assertAlmostEqual(self.value(tir) / before, 1.5 / 2.1, delta=0.05)

    def test_the_tire_inside_a_unit_has_the_ranges_and_origins_of_the_exported_file(self):
        tir, unit = self.folder / "fitted.tir", self.folder / "fitted.fmu"
        self.run_it("run", self.study)
        self.run_it("export", self.study, "--model", tir)
        self.run_it("export", self.study, "--fmu", "2.0", "-o", unit)
        with zipfile.ZipFile(unit) as package:
            inside = [name for name in package.namelist() if name.endswith(".tir")]
            self.assertEqual(len(inside), 1, package.namelist())
            text = package.read(inside[0]).decode()
            numbers = package.read("resources/model.toml").decode()
        self.assertEqual(text, tir.read_text())
        self.assertRegex(text, r"(?m)^FZMAX *= *1200 ")
        self.assertIn("from the data", text)
        self.assertIn('FZMAX = "1200 N"', numbers)


if __name__ == "__main__":
    unittest.main()
