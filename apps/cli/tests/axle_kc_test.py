#!/usr/bin/env python3
"""Tests an axle on the K&C rig. With its springs locked each wheel gives the results of its corner in the test kc,
and with rigid joints those of the rigid linkage in the test kinematics. The compliance matrix equals finite
differences."""
import csv
import io
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

LATSCH = str(pathlib.Path(sys.argv.pop(1)).resolve())
STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"


def run(model, test, *more):
    done = subprocess.run([LATSCH, "test", str(STUDIES / model), test, *more], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    rows = list(csv.reader(io.StringIO(done.stdout)))
    names = [name.split(" ")[0] for name in rows[0]]
    return {name: [float(row[i]) for row in rows[1:] if row[i]] for i, name in enumerate(names)}


class AxleKc(unittest.TestCase):
    def test_rigid_joints_give_the_curves_of_the_linkage(self):
        travel = 'travel = ["-20 mm", "-10 mm", "0 mm", "10 mm", "20 mm"]'
        rig = run("kerb/baseline.toml", '{kind = "axle_kc", axle = "front", ' + travel + "}")
        linkage = run("suspensions/race_car_front.toml", '{kind = "kinematics", ' + travel + "}")
        for name in ("camber", "toe", "caster"):
            start = linkage[name][2]
            for i in range(5):
                # The joints have 10^10 N/m, whose compliance causes less than a thousandth of a degree.
                self.assertAlmostEqual(rig[name + "_L"][i] - rig[name + "_L"][2], linkage[name][i] - start, delta=2e-5,
                                       msg=f"{name} {i}")
                self.assertAlmostEqual(rig[name + "_L"][i], rig[name + "_R"][i], delta=1e-8)

    def test_opposed_and_single(self):
        opposed = run("kerb/proposed.toml", '{kind = "axle_kc", axle = "rear", mode = "opposed", travel = ["20 mm"]}')
        self.assertAlmostEqual(opposed["dz_L"][0], -opposed["dz_R"][0], delta=2e-4)
        single = run("kerb/proposed.toml", '{kind = "axle_kc", axle = "rear", mode = "single", travel = ["20 mm"]}')
        # no anti-roll bar couples the two wheels
        self.assertAlmostEqual(single["camber_L"][0], opposed["camber_L"][0], delta=1e-6)
        self.assertAlmostEqual(single["camber_R"][0], 0.0, delta=1e-7)

    def test_a_rear_axle_has_no_rack(self):
        done = subprocess.run([LATSCH, "test", str(STUDIES / "kerb" / "baseline.toml"), '{kind = "axle_kc", axle = "rear", rack = "5 mm"}'],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("the rear axle of a car has no rack", done.stderr)

    def test_a_rack_steers_both(self):
        steer = run("kerb/baseline.toml", '{kind = "axle_kc", axle = "front", travel = "0 mm", rack = ["0 mm", "5 mm"]}')
        self.assertGreater(abs(steer["toe_L"][1]), 0.02)
        self.assertLess(abs(steer["toe_L"][1] + steer["toe_R"][1]), 0.1 * abs(steer["toe_L"][1]))

    def test_the_matrix_is_that_of_differences_and_symmetric(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "matrix.csv"
            test = '{kind = "axle_kc", axle = "front", springs = "locked", mode = "single", Fy = ["-50 N", "0 N", "50 N"]}'
            moved = run("kerb/proposed.toml", test)
            subprocess.run([LATSCH, "test", str(STUDIES / "kerb/proposed.toml"), test, "--details", str(file),
                            "-o", str(pathlib.Path(folder) / "moved.csv")], check=True, capture_output=True)
            with open(file) as text:
                rows = list(csv.reader(text))
        matrix = {name.split(" ")[0]: float(value) for name, value in zip(rows[0], rows[2])}
        slope = (moved["dy_L"][2] - moved["dy_L"][0]) / 100.0
        self.assertAlmostEqual(matrix["dy_L_by_Fy_L"] / slope, 1.0, delta=1e-4)
        self.assertAlmostEqual(matrix["dz_L_by_Fy_L"] / matrix["dy_L_by_Fz_L"], 1.0, delta=1e-5)
        self.assertAlmostEqual(matrix["about_z_L_by_Fy_L"] / matrix["dy_L_by_Mz_L"], 1.0, delta=1e-5)

    def test_a_recording_drives_each_wheel_and_its_slopes_are_those_of_the_recording(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            axle = 'axle = "rear", springs = "locked"'
            cycle = [0, 1, 2, 3, 2, 1, 0, -1, -2, -3, -2, -1, 0]
            left, right = (", ".join(f'"{share * x} kN"' for x in cycle) for share in (1.0, -0.5))
            model = "compliance/rear_axle/specimen.toml"
            test = (f'{{kind = "axle_kc", {axle}, Fy_L = [{left}], Fy_R = [{right}], '
                    'slopes_by = "Fy_L", window = ["-2.5 kN", "2.5 kN"]}')
            rig = run(model, test)
            subprocess.run([LATSCH, "test", str(STUDIES / model), test, "--html", str(folder / "loops.html")], check=True,
                           capture_output=True)
            # Because of friction the curve of unloading differs from that of loading.
            self.assertGreater(abs(rig["toe_L"][5] - rig["toe_L"][1]), 0.02 * abs(rig["toe_L"][1]))
            page = (folder / "loops.html").read_text()
            self.assertIn("toe_R_by_Fy_L", page)
            inside = [i for i, x in enumerate(rig["Fy_L"]) if abs(x) < 2500.0]
            x, y = ([rig[of][i] for i in inside] for of in ("Fy_L", "toe_R"))
            mean = sum(x) / len(x)
            slope = sum((a - mean) * b for a, b in zip(x, y)) / sum((a - mean) ** 2 for a in x)
            self.assertAlmostEqual(rig["toe_R_by_Fy_L"][0] / slope, 1.0, delta=1e-9)
            # The measurement comes from the same kind of model, so the fit must find its stiffness, from a start five
            # times too soft.
            rig = run("compliance/rear_axle/car.toml", test)
            with open(folder / "rig.csv", "w", newline="") as file:
                table = csv.writer(file)
                table.writerow(["Fy_L [N]", "Fy_R [N]", "toe_R [rad]"])
                table.writerows(zip(rig["Fy_L"], rig["Fy_R"], rig["toe_R"]))
            model = STUDIES / "compliance" / "rear_axle" / "car.toml"
            (folder / "study.toml").write_text(
                f'model = "{model}"\nmeasurement.rig = {{file = "rig.csv"}}\n'
                f'test.rig = {{kind = "axle_kc", {axle}, loads = {{from = "measurement.rig"}}, slopes_by = "Fy_L", '
                'window = ["-2.5 kN", "2.5 kN"]}\n'
                'variable.toe_link = {path = "rear_suspension.bushing.trackrod_inner.y", lower = "1 kN/mm", '
                'upper = "900 kN/mm", initial = "20 kN/mm", scale = "logarithmic"}\n'
                '[experiment.toe]\nkind = "values"\nchannel = "rig/toe_R_by_Fy_L"\nmeasurement = "rig"\nexponent = 2\n')
            study = str(folder / "study.toml")
            done = subprocess.run([LATSCH, "check", "--derivatives", study], capture_output=True, text=True)
            self.assertIn("All of them agree", done.stdout + done.stderr)
            done = subprocess.run([LATSCH, "run", study], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            found = re.search(r"toe_link +([\d.]+) kN/mm", done.stdout)
            self.assertTrue(found, done.stdout)
            text = (STUDIES / "compliance" / "rear_axle" / "rear.toml").read_text().split("[bushing.trackrod_inner]")[1]
            self.assertAlmostEqual(float(found[1]) / float(re.search(r'y = "([\d.]+) kN/mm"', text)[1]), 1.0, delta=0.05)  # as it is printed

    def test_the_study_of_the_rear_axle_predicts_the_load_it_was_not_fitted_to(self):
        with tempfile.TemporaryDirectory() as name:
            studies = pathlib.Path(name) / "studies"
            shutil.copytree(STUDIES / "compliance" / "rear_axle", studies / "compliance" / "rear_axle")
            (studies / "kerb").mkdir()
            shutil.copy(STUDIES / "kerb" / "front.toml", studies / "kerb")
            study = studies / "compliance" / "rear_axle" / "study.toml"
            done = subprocess.run([LATSCH, "run", str(study)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("counts twice", done.stderr)
            values = study.with_suffix(".html").read_text().split('<section id="values">')[1].split("</section>")[0]
        cells = lambda row: [re.sub("<.*?>", "", cell).replace("\N{MINUS SIGN}", "-").replace("&minus;", "-")
                             for cell in re.findall("<td.*?>(.*?)</td>", row, re.S)]
        held_out, fitted = 0, 0
        for row in map(cells, re.findall("<tr>(.*?)</tr>", values, re.S)):
            if not row:
                continue
            measured = float(row[2])
            low, high = map(float, row[7].split(" .. "))
            if row[1] == "predicted":
                self.assertTrue(low <= measured <= high, row)
                held_out += 1
            elif "_by_Mz" not in row[0]:
                self.assertLess(abs(float(row[5]) / measured - 1.0), 0.02, row)
                fitted += 1
        self.assertEqual((held_out, fitted), (12, 48))

    def test_signs_of_others(self):
        test = '{kind = "axle_kc", axle = "front", Fy = "1 kN", travel = "5 mm", rack = "2 mm"}'
        iso, sae = run("kerb/proposed.toml", test), run("kerb/proposed.toml", test, "--signs", "sae")
        changed = {name for name in iso if sae[name] != iso[name]}
        self.assertTrue({"Fy", "rack", "dy_L", "dy_R", "dz_L", "pad_L", "pad_R"} <= changed)
        self.assertFalse({"travel", "dx_L", "camber_L", "toe_R", "caster_L", "spring_L"} & changed)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "matrix.csv"
            rows = []
            for view in ("iso", "sae", "adams"):
                subprocess.run([LATSCH, "test", str(STUDIES / "kerb/proposed.toml"), test, "--details", str(file), "--signs", view,
                                "-o", str(pathlib.Path(folder) / "moved.csv")], check=True, capture_output=True)
                names, values = csv.reader(io.StringIO(file.read_text()))
                rows.append({name.split(" ")[0]: float(value) for name, value in zip(names, values)})
        iso, sae, adams = rows
        for name, signs in (("lateral_force_toe_in_phase", (-1, -1)), ("longitudinal_force_toe_out_of_phase", (1, -1)),
                            ("aligning_torque_camber_in_phase", (-1, 1)), ("vertical_compliance_in_phase", (1, 1)),
                            ("dz_L_by_Fy_R", (1, -1)), ("about_z_R_by_Fy_L", (1, -1))):
            self.assertEqual((sae[name], adams[name]), tuple(sign * iso[name] for sign in signs), name)

    def test_typos_are_named(self):
        for test, word in (('{kind = "axle_kc", axle = "middle"}', "front"),
                           ('{kind = "axle_kc", axle = "front"}', "Fz"),
                           ('{kind = "axle_kc", axle = "front", mode = "single"}', "Fz is missing"),
                           ('{kind = "axle_kc", axle = "front", Fz = "1 kN", Fy_L = "1 kN"}', "Fz beside Fy_L"),
                           ('{kind = "axle_kc", axle = "front", Fz_R = "1 kN", mode = "single"}', "no mode"),
                           ('{kind = "axle_kc", axle = "front", Fz = ["1 kN", "1 kN"], slopes_by = "Fz"}', "does not vary"),
                           ('{kind = "axle_kc", axle = "front", Fz = {from = "measurement.a"}}', "only a test of a study"),
                           ('{kind = "axle_kc", axle = "front", Fz = ["1 kN", "2 kN"], Fy = ["1 N", "2 N", "3 N"]}', "has 2")):
            done = subprocess.run([LATSCH, "test", str(STUDIES / "kerb/baseline.toml"), test], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(word, done.stderr)


class AxesOfTables(unittest.TestCase):
    """A table of both wheels whose study states no axes: the axes are offered, whatever the number of its rows."""
    # signs by which the columns of a table in these axes differ from iso
    TURNED = {"iso": "", "sae": "Fy Fz My Mz dy dz", "adapted_sae": "Fy My Mz dy dz", "adams": "Fx Fy Mx My dx dy"}

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_axes_"))
        shutil.copytree(STUDIES / "kerb", cls.folder / "kerb", ignore=shutil.ignore_patterns("*.latsch", "*.html"))
        cls.rows = {}
        for rows in (4, 14):
            value = lambda k, most, i: most * math.sin(1.3 * k + (2.1 + 0.37 * k) * i)
            loads = {f"{name}_{side}": [value(3 * n + (side == "R"), most, i) + (3000 if name == "Fz" else 0) for i in range(rows)]
                     for n, (name, most) in enumerate((("Fx", 1500), ("Fy", 2000), ("Fz", 900), ("Mz", 60))) for side in "LR"}
            stated = ", ".join(name + " = [" + ", ".join(f'"{x:.6g} {"N m" if name[0] == "M" else "N"}"' for x in values) + "]"
                               for name, values in loads.items())
            cls.rows[rows] = run("kerb/proposed.toml", '{kind = "axle_kc", axle = "rear", springs = "locked", ' + stated + "}")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def study(self, axes, rows, lines="", head=lambda name: name, at=""):
        """Writes a study of a table in these axes and returns what check and simulate say."""
        table = {name: values for name, values in self.rows[rows].items() if re.match("[FM][xyz]_|d[xyz]_|toe|camber|caster", name)}
        unit = lambda name: {"F": "N", "M": "N m", "d": "m"}.get(name[0], "rad")
        signs = {name: -1 if name[:2] in self.TURNED[axes].split() else 1 for name in table}
        text = ",".join(f"{head(name)} [{unit(name)}]" for name in table) + "\n"
        for i in range(rows):
            text += ",".join(f"{signs[name] * values[i]:.12g}" for name, values in table.items()) + "\n"
        (self.folder / "rig.csv").write_text(text)
        study = self.folder / "study.toml"
        study.write_text('model = "kerb/proposed.toml"\n[measurement.rig]\nfile = "rig.csv"\n' + lines + '\n[test.t]\nkind = "axle_kc"\n'
                         f'axle = "rear"\nsprings = "locked"\nloads = {{from = "measurement.rig"}}\n{at}\n'
                         '[variable.v]\npath = "chassis.mass"\nlower = "100 kg"\nupper = "2000 kg"\ninitial = "700 kg"\n' +
                         "".join(f'[experiment.{name}]\nkind = "curve"\ny = "t/{name}"\nmeasurement = "rig"\n' for name in ("dx_L", "dy_R", "toe_L", "camber_R")))
        done = subprocess.run([LATSCH, "check", study], capture_output=True, text=True)
        return done.stdout + done.stderr

    def test_every_table_is_offered_the_axes_that_it_is_in(self):
        for rows in (4, 14):
            for axes in ("sae", "adapted_sae", "adams"):
                with self.subTest(rows=rows, axes=axes):
                    self.assertRegex(self.study(axes, rows), f'axes = ("iso", )?("iso" or )?"{axes}"')
                    self.assertNotRegex(self.study(axes, rows, f'axes = "{axes}"'), "states no axes|the signs agree")
        self.assertNotRegex(self.study("iso", 4, 'axes = "iso"'), "states no axes|the signs agree")

    def test_only_loads_of_wheels_are_told_as_absent_beside_those_of_wheels(self):
        said = self.study("iso", 14, 'axes = "iso"')
        self.assertIn("Mx_L is taken as 0 by test t", said)
        self.assertNotIn("Fx is taken as 0", said)
        self.assertNotIn("Mx is taken as 0", said)

    def test_loads_in_another_frame_are_refused(self):
        framed = lambda frame: lambda name: name[:2] + frame + name[2:] if name[0] in "FM" else name
        self.assertNotIn("the test takes it", self.study("iso", 14, 'axes = "iso"', framed("W")))
        said = self.study("iso", 14, 'axes = "iso"', framed("H"))
        self.assertIn("Fx_L is in axes H, at the wheel center, but the test takes it in axes W, at the contact patch", said)
        self.assertIn('say at = "wheel_center" in the test', said)
        self.assertNotIn("in_frame", said)
        self.assertNotIn("the test takes it", self.study("iso", 14, 'axes = "iso"', framed("H"), 'at = "wheel_center"'))
        self.assertIn("is in axes H, at the wheel center", self.study("iso", 14, 'axes = "iso"\nframe = "H"'))
        self.assertNotIn("the test takes it", self.study("iso", 14, 'axes = "iso"\nframe = "W"'))


if __name__ == "__main__":
    unittest.main()
