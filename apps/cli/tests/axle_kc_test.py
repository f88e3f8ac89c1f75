#!/usr/bin/env python3
"""An axle on the K&C rig: with its springs locked each wheel is the corner of the test kc; with rigid joints its curves
are those of the rigid linkage of the test kinematics; the compliance matrix is that of differences."""
import csv
import io
import pathlib
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
    return {name: [float(row[i]) for row in rows[1:]] for i, name in enumerate(names)}


class AxleKc(unittest.TestCase):
    def test_rigid_joints_give_the_curves_of_the_linkage(self):
        travel = 'travel = ["-20 mm", "-10 mm", "0 mm", "10 mm", "20 mm"]'
        rig = run("kerb/baseline.toml", '{kind = "axle_kc", axle = "front", ' + travel + "}")
        linkage = run("suspensions/race_car_front.toml", '{kind = "kinematics", ' + travel + "}")
        for name in ("camber", "toe", "caster"):
            start = linkage[name][2]
            for i in range(5):
                # 10^10 N/m in each joint leaves less than a thousandth of a degree.
                self.assertAlmostEqual(rig[name + "_L"][i] - rig[name + "_L"][2], linkage[name][i] - start, delta=2e-5,
                                       msg=f"{name} {i}")
                self.assertAlmostEqual(rig[name + "_L"][i], rig[name + "_R"][i], delta=1e-8)

    def test_opposed_and_single(self):
        opposed = run("kerb/proposed.toml", '{kind = "axle_kc", axle = "rear", mode = "opposed", travel = ["20 mm"]}')
        self.assertAlmostEqual(opposed["dz_L"][0], -opposed["dz_R"][0], delta=2e-4)
        single = run("kerb/proposed.toml", '{kind = "axle_kc", axle = "rear", mode = "single", travel = ["20 mm"]}')
        self.assertAlmostEqual(single["camber_L"][0], opposed["camber_L"][0], delta=1e-6)  # no bar couples them
        self.assertAlmostEqual(single["camber_R"][0], 0.0, delta=1e-7)

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
                           ('{kind = "axle_kc", axle = "front", Fz = ["1 kN", "2 kN"], Fy = ["1 N", "2 N", "3 N"]}', "has 2")):
            done = subprocess.run([LATSCH, "test", str(STUDIES / "kerb/baseline.toml"), test], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
