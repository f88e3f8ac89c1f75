#!/usr/bin/env python3
"""Tests the tables of `latsch export SUSPENSION --kc FOLDER` against the tests of the same suspension, a Simbody
program, the description in kc.json, and a reader of Modelica's text tables.

   kc_tables_test.py PATH/TO/latsch"""
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, WRONG_INPUT

ROOT = pathlib.Path(__file__).resolve().parents[4]
SUSPENSIONS = ROOT / "studies" / "suspensions"
SIMBODY = ROOT / "verification" / "simbody"
MOTIONS = ("dx", "dy", "dz", "about_x", "about_y", "about_z")
LOADS = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
# A right wheel is the mirror image of a left one: y, and rotations about x and z, change their signs.
MIRROR = (1, -1, 1, -1, 1, -1)


def columns(file):
    """Returns a table as {name: numbers} and its units."""
    with open(file, newline="") as lines:
        rows = [row for row in csv.reader(lines) if not row[0].startswith("#")]
    names = [title.split(" [")[0] for title in rows[0]]
    units = {name: title.split(" [")[1][:-1] for name, title in zip(names, rows[0])}
    return dict(zip(names, zip(*[[float(cell) for cell in row] for row in rows[1:]]))), units


def modelica_tables(file):
    """Reads a text file of Modelica's tables: `#1`, then `double NAME(rows,columns)` and so many numbers."""
    lines = file.read_text().split("\n")
    assert lines[0] == "#1", lines[0]
    tables, at = {}, 1
    while at < len(lines):
        line = lines[at].split("#")[0].strip()
        at += 1
        if not line:
            continue
        kind, _, rest = line.partition(" ")
        assert kind == "double", line
        name, _, size = rest.partition("(")
        rows, columns_of_table = (int(number) for number in size.rstrip(")").split(","))
        assert name.isidentifier() and name not in tables, name
        tables[name] = [[float(number) for number in lines[at + i].split()] for i in range(rows)]
        assert all(len(row) == columns_of_table for row in tables[name]), name
        at += rows
    return tables


class KcTables(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_kc_tables_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout + run.stderr

    def export(self, model, *more):
        into = self.folder / "tables"
        said = self.latsch("export", model, "--kc", into, *more)
        return into, said

    def recorded(self, model, test, *more):
        file = self.folder / "recorded.csv"
        self.latsch("test", model, test, "-o", file, *more)
        return columns(file)[0]

    def test_kinematics_are_those_of_the_test(self):
        for name in ("race_car_front.toml", "five_link_rear.toml", "lotus_bat.toml"):
            model = SUSPENSIONS / name
            side = "L" if 'side = "left"' in model.read_text() else "R"
            into, _ = self.export(model, "--kc-travel", "20 mm", "--kc-rack", "8 mm")
            table, _ = columns(into / "kinematics.csv")
            self.assertEqual(len(table["travel"]), 21 * 9)
            for rack in ("-8 mm", "0 mm", "4 mm"):
                rig = self.recorded(model, '{kind = "kinematics", travel = ["-20 mm", "6 mm", "20 mm"], '
                                           f'rack = "{rack}", at = "wheel_center"}}')
                for i, travel in enumerate(rig["travel"]):
                    row = next(k for k in range(21 * 9) if abs(table["travel"][k] - travel) < 1e-12 and
                               abs(table["rack"][k] - rig["rack"][i]) < 1e-12)
                    for channel in ("toe", "camber", "caster", "steer", "contact_x", "contact_y", "contact_z", "center_x",
                                    "center_y", "bump_camber", "kpi", "roll_center_height"):
                        self.assertAlmostEqual(table[f"{channel}_{side}"][row], rig[channel][i], delta=1e-9, msg=channel)

    def test_the_wheels_mirror_each_other(self):
        into, _ = self.export(SUSPENSIONS / "race_car_front.toml", "--kc-rack", "8 mm", "--kc-travel", "20 mm")
        table, _ = columns(into / "kinematics.csv")
        rows = {(round(z, 9), round(y, 9)): k for k, (z, y) in enumerate(zip(table["travel"], table["rack"]))}
        for (z, y), k in rows.items():
            image = rows[(z, round(-y, 9) + 0.0)]
            for name, sign in (("toe", 1), ("camber", 1), ("steer", -1), ("center_y", -1), ("contact_x", 1)):
                self.assertAlmostEqual(table[name + "_L"][k], sign * table[name + "_R"][image], delta=1e-9)

    def test_compliance_at_rest_is_that_of_the_rig(self):
        corner = ROOT / "studies" / "compliance" / "corner.toml"
        into, _ = self.export(corner, "--kc-travel", "30 mm")
        details = self.folder / "details.csv"
        self.latsch("test", corner, '{kind = "kc", Fz = "0 N"}', "--details", details, "-o", self.folder / "kc.csv")
        rig, units_of_rig = columns(details)
        table, units = columns(into / "compliance.csv")
        rest = min(range(21), key=lambda k: abs(table["travel"][k]))
        self.assertEqual(table["travel"][rest], 0.0)
        for i, motion in enumerate(MOTIONS):
            for j, load in enumerate(LOADS):
                expected, scale = rig[f"{motion}_by_{load}"][0], max(map(abs, (rig[f"{motion}_by_{l}"][0] for l in LOADS)))
                self.assertAlmostEqual(table[f"{motion}_L_by_{load}_L"][rest], expected, delta=1e-7 * scale)
                self.assertAlmostEqual(table[f"{motion}_R_by_{load}_R"][rest], MIRROR[i] * MIRROR[j] * expected,
                                       delta=1e-7 * scale)
                self.assertEqual(units[f"{motion}_L_by_{load}_L"], units_of_rig[f"{motion}_by_{load}"])
                self.assertEqual(set(table[f"{motion}_L_by_{load}_R"]), {0.0})
        for k in range(21):  # an elastic corner has a symmetric matrix
            self.assertAlmostEqual(table["dy_L_by_Mz_L"][k], table["about_z_L_by_Fy_L"][k], delta=1e-12)

    def test_compliance_times_load_is_the_motion_that_simbody_computes(self):
        """The loads move the wheel by some 1 mm on links of 300 mm: the linear motion differs by less than 2 %."""
        case = json.loads((SIMBODY / "fsae_corner.json").read_text())
        points = {b["name"]: b["point"] for b in case["bushings"]}
        of_case = {"uca_front": "uca_chassis_front", "uca_rear": "uca_chassis_rear", "lca_front": "lca_chassis_front",
                   "lca_rear": "lca_chassis_rear"}
        corner = ROOT / "studies" / "compliance" / "corner.toml"
        text = corner.read_text()
        text = text[:text.index("# Relatively stiff")] + "[bushing.all]\n" + "".join(
            f'{axis} = "30 kN/mm"\nabout_{axis} = "200 N m/rad"\n' for axis in "xyz")
        model = self.folder / "corner.toml"
        model.write_text(text)
        for own, other in of_case.items():  # the case has the hardpoints of the file
            if other in points:
                self.assertIn(f"{1e3 * points[other][0]:.3f} mm", text, own)
        into, _ = self.export(model, "--kc-travel", "10 mm")
        table, _ = columns(into / "compliance.csv")
        rest = table["travel"].index(0.0)
        loads = {one["name"]: one["loads"][0] for one in case["load_cases"]}
        with open(SIMBODY / "fsae_corner_simbody.csv", newline="") as file:
            moved = {row["case"]: [float(row[axis]) for axis in "xyz"]
                     for row in csv.DictReader(file) if row["kind"] == "point" and row["name"] == "contact"}
        for name in ("Fz +5 kN", "Fy -4 kN", "Fx -4 kN", "Mz +200 Nm", "combined"):
            load = loads[name]["force"] + loads[name]["moment"]
            largest = max(map(abs, moved[name]))
            for i, motion in enumerate(MOTIONS[:3]):
                linear = sum(table[f"{motion}_L_by_{of}_L"][rest] * value for of, value in zip(LOADS, load))
                self.assertAlmostEqual(linear, moved[name][i], delta=0.02 * largest, msg=f"{name} {motion}")

    def test_the_description_names_every_column(self):
        model = ROOT / "studies" / "compliance" / "corner.toml"
        into, said = self.export(model, "--kc-rack", "0 mm", "--kc-travel", "20 mm")
        about = json.loads((into / "kc.json").read_text())
        for name, table in about["files"].items():
            if not name.endswith(".csv"):
                continue
            numbers, units = columns(into / name)
            self.assertEqual([column["name"] for column in table["columns"]], list(numbers))
            self.assertEqual([column["unit"] for column in table["columns"]], list(units.values()))
            self.assertEqual(table["rows"], len(next(iter(numbers.values()))))
            self.assertTrue(all(column["meaning"] for column in table["columns"]))
        self.assertEqual(sorted(path.name for path in into.iterdir()), sorted(about["files"]) + ["kc.json"]
                         if sorted(about["files"])[-1] < "kc.json" else sorted([*about["files"], "kc.json"]))
        self.assertEqual(about["wheel_center"]["right"][1], -about["wheel_center"]["left"][1])
        self.assertAlmostEqual(about["contact"]["left"][2], 0.0, delta=1e-9)
        self.assertIn("ISO 8855", said)
        self.assertIn("springs.csv has no rates", said)

    def test_modelica_tables_hold_the_same_numbers(self):
        into, _ = self.export(SUSPENSIONS / "race_car_front.toml", "--kc-travel", "20 mm", "--kc-rack", "8 mm")
        tables = modelica_tables(into / "kc_tables.txt")
        kinematics, _ = columns(into / "kinematics.csv")
        self.assertEqual(len([name for name in tables if name in kinematics]), len(kinematics) - 2)
        toe = tables["toe_R"]
        self.assertEqual(toe[0][0], 0.0)
        for i in range(21):
            self.assertEqual(toe[i + 1][0], kinematics["travel"][9 * i])
            self.assertEqual(toe[i + 1][1:], list(kinematics["toe_R"][9 * i:9 * i + 9]))
        self.assertEqual(toe[0][1:], list(kinematics["rack"][:9]))
        springs, _ = columns(into / "springs.csv")
        self.assertEqual(list(zip(*tables["springs"])), list(springs.values()))

    def test_what_cannot_be_written_is_said(self):
        rigid = SUSPENSIONS / "race_car_front.toml"
        _, said = self.export(rigid, "--kc-travel", "20 mm", "--kc-rack", "8 mm")
        self.assertIn("Compliance: none: the suspension's file has no bushings", said)
        for model, more, part in (
                (rigid, ("--kc-travel", "400 mm"), "at a travel of"),
                (rigid, ("--kc-travel", "20"), "--kc-travel"),
                (rigid, ("--kc-travel", "20 deg"), "--kc-travel"),
                (rigid, ("--kc-travel", "0 mm"), "expected a range of travel"),
                (ROOT / "studies" / "kerb" / "baseline.toml", (), "expected a suspension"),
                (ROOT / "studies" / "ring_tires" / "passenger_205_55R16.toml", (), "expected a suspension")):
            self.assertIn(part, self.latsch("export", model, "--kc", self.folder / "none", *more, code=WRONG_INPUT))
        self.assertFalse((self.folder / "none").exists())


if __name__ == "__main__":
    unittest.main()
