#!/usr/bin/env python3
"""Tests suspensions with rigid links: published static values, five links, a study of hardpoints, and refused input.

   kinematics_test.py PATH/TO/latsch"""
import csv
import io
import math
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, edit

SUSPENSIONS = pathlib.Path(__file__).resolve().parents[3] / "studies" / "suspensions"
TRAVEL = '{kind = "kinematics", travel = ["-20 mm", "0 mm", "20 mm"]}'


class Kinematics(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_kinematics_"))
        self.addCleanup(shutil.rmtree, self.folder)
        for file in SUSPENSIONS.glob("*.toml"):
            shutil.copy(file, self.folder)
        self.front = self.folder / "race_car_front.toml"

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout + run.stderr

    def rows(self, test, model=None, signs="iso"):
        table = csv.reader(io.StringIO(self.latsch("test", model or self.front, test, "--signs", signs)))
        names = [name.split(" [")[0] for name in next(table)]
        return [dict(zip(names, map(float, row))) for row in table]

    def test_static_values_of_the_example_are_the_printed_ones(self):  # published in verification/lotus_shark
        row = self.rows('{kind = "kinematics", travel = "0 mm"}', self.folder / "lotus_bat.toml")[0]
        for name, printed in (("caster", 15.71), ("kpi", 17.53)):
            self.assertAlmostEqual(math.degrees(row[name]), printed, delta=0.005)
        for name, printed in (("mechanical_trail", 59.79), ("caster_offset", 62.11), ("caster_trail_hub", 1.16),
                              ("scrub_radius", 21.39), ("kingpin_offset", 92.47)):
            self.assertAlmostEqual(1e3 * row[name], printed, delta=0.005)
        self.assertAlmostEqual(1e3 * row["axle_roll_center_height"], 196.89, delta=0.1)

    def test_every_file_that_is_shipped_moves(self):
        for file in self.folder.glob("*.toml"):
            for mode in ("parallel", "opposed", "single"):
                rows = self.rows(f'{{kind = "kinematics", from = "-20 mm", to = "20 mm", points = 5, mode = "{mode}"}}', file)
                self.assertEqual(len(rows), 5)
                self.assertAlmostEqual(rows[0]["other_travel"], {"parallel": -0.02, "opposed": 0.02, "single": 0.0}[mode])
                self.assertTrue(all(math.isfinite(value) for row in rows for value in row.values()), file)

    def test_the_same_links_as_five_move_the_same(self):
        text = self.front.read_text()
        points = dict(re.findall(r"^(\w+) = (\[.*\])$", text, re.M))
        links = "".join(f"[link.{inner}]\ninner = {points[inner]}\nouter = {points[outer]}\n"
                        for inner, outer in (("uca_front", "ubj"), ("uca_rear", "ubj"), ("lca_front", "lbj"), ("lca_rear", "lbj"),
                                             ("trackrod_inner", "trackrod_outer")))
        hardpoints = "".join(f"{name} = {points[name]}\n" for name in ("pushrod_inner", "pushrod_outer", "wheel_center", "contact"))
        five = self.folder / "five.toml"
        five.write_text(f'kind = "suspension"\ntype = "five_link"\nside = "left"\ntrackrod = "trackrod_inner"\n'
                        f"[hardpoint]\n{hardpoints}{links}")
        test = '{kind = "kinematics", travel = ["-20 mm", "20 mm"], rack = ["5 mm", "-10 mm"], mode = "opposed", wheelbase = "1.55 m"}'
        for one, other in zip(self.rows(test), self.rows(test, five)):
            for name in ("toe", "camber", "bump_steer", "roll_center_height", "axle_roll_center_y", "other_camber", "ackermann"):
                self.assertAlmostEqual(one[name], other[name], delta=1e-9, msg=name)
        self.assertIn("bushing", self.latsch("test", five, '{kind = "kc", Fz = "1 kN"}', code=WRONG_INPUT))
        edit(five, (r"\[link.lca_rear\]\n.*\n.*\n", ""))
        self.assertIn("has 4 links, expected five", self.latsch("test", five, TRAVEL, code=WRONG_INPUT))

    def table_of_points(self, spoil=lambda rows: rows, head="of,name,x [mm],y [mm],z [mm]"):
        """Writes the front axle with its hardpoints in a table that also contains those of another corner."""
        text = self.front.read_text()
        points = re.findall(r'^(\w+) = \["([-\d.]+) mm", "([-\d.]+) mm", "([-\d.]+) mm"\]$', text, re.M)
        rows = [["FL", *point] for point in points] + [["RL", "ubj", "-25.6", "530.8", "350"]]
        (self.folder / "points.csv").write_text("# from a drawing\n" + head + "\n" + "".join(",".join(row) + "\n" for row in spoil(rows)))
        filed = self.folder / "filed.toml"
        filed.write_text(re.sub(r"\[hardpoint\]\n(.+\n)+", "", text).replace(
            'side = "left"\n', 'side = "left"\nhardpoints = "points.csv"  # of the car\nhardpoints_of = "FL"\n'))
        return filed

    def test_hardpoints_from_a_table_are_those_in_the_file(self):
        filed = self.table_of_points()
        self.assertEqual(self.latsch("test", filed, TRAVEL), self.latsch("test", self.front, TRAVEL))
        (self.folder / "study.toml").write_text(
            'title = "Bump steer"\nmodel = "filed.toml"\n[test.bump]\nkind = "kinematics"\ntravel = "10 mm"\n'
            '[variable.z]\npath = "hardpoint.trackrod_inner.2"\nlower = "110 mm"\nupper = "130 mm"\ninitial = "119.872 mm"\n'
            '[experiment.toe]\nkind = "values"\nchannel = "bump/toe"\nvalue = "0.01 rad"\n')
        self.assertIn("119.87 mm", self.latsch("check", self.folder / "study.toml"))

    def test_a_table_in_axes_whose_x_points_rearward_is_doubted(self):
        self.assertNotIn("axes of Adams", self.latsch("check", self.table_of_points()))
        rearward = self.table_of_points(lambda rows: [[corner, name, str(-float(x)), y, z] for corner, name, x, y, z in rows])
        self.assertIn("axes of Adams", self.latsch("check", rearward))

    def test_what_is_no_table_of_hardpoints_is_refused_in_words(self):
        def refused(spoil, *parts, code=WRONG_INPUT, **more):
            text = self.latsch("test", self.table_of_points(spoil, **more), TRAVEL, code=code)
            for part in parts:
                self.assertIn(part, text)

        at = lambda i, j, new: lambda rows: rows[:i] + [rows[i][:j] + [new] + rows[i][j + 1:]] + rows[i + 1:]
        refused(at(3, 2, "abc"), "points.csv:6", "abc")
        refused(at(3, 1, "lca_raer"), "points.csv:6", "lca_raer", "lca_rear")
        refused(at(3, 1, "lca rear"), "points.csv:6", "not a name of a point")
        refused(at(3, 1, "uca_rear"), "points.csv:6", "comes twice, before in line 4")
        refused(lambda rows: [row for row in rows if row[1] != "wheel_center"], "points.csv", "wheel_center is missing")
        refused(at(4, 2, "1510800"), "points.csv", "ubj is more than 50 m from the origin")
        refused(lambda rows: [["FR", *row[1:]] for row in rows], "points of FR", "hardpoints_of")
        refused(lambda rows: rows, "points.csv:2", "x", head="of,name,x [N],y [mm],z [mm]")
        filed = self.table_of_points()
        edit(filed, (r'hardpoints_of = "FL"\n', ""))
        self.assertIn("of FL, RL: of several corners", self.latsch("test", filed, TRAVEL, code=WRONG_INPUT))
        edit(filed, (r'hardpoints = .*\n', 'hardpoints_of = "FL"\n'))
        self.assertIn("hardpoints_of", self.latsch("test", filed, TRAVEL, code=WRONG_INPUT))
        edit(self.front, (r'\[hardpoint\]', 'hardpoints = "points.csv"\n[hardpoint]'))
        self.assertIn("is given beside [hardpoint]", self.latsch("test", self.front, TRAVEL, code=WRONG_INPUT))

    # Lines after a table of hardpoints keep their line number in the file.
    def test_lines_behind_a_table_of_hardpoints_are_those_of_the_file(self):
        filed = self.table_of_points()
        edit(filed, (r"\[spring\]", "[spring]\nstifness = 3"))
        line = filed.read_text().splitlines().index("stifness = 3") + 1
        self.assertIn(f"filed.toml:{line}: ", self.latsch("test", filed, TRAVEL, code=WRONG_INPUT))

    def test_the_rack_steers_both_wheels(self):
        rows = self.rows('{kind = "kinematics", rack = ["-15 mm", "0 mm", "15 mm"], wheelbase = "1.55 m", rack_per_turn = "85 mm"}')
        for row, image in zip(rows, reversed(rows)):
            self.assertAlmostEqual(row["steer"], -image["other_steer"], delta=1e-12)
            self.assertAlmostEqual(row["ackermann"], image["ackermann"], delta=1e-6)
        self.assertGreater(abs(rows[0]["steer"]), 0.2)
        # The Ackermann value at zero steer is a limit. It continues the curve, as a parabola through its neighbors
        # shows.
        near = self.rows('{kind = "kinematics", rack = ["-2 mm", "0 mm", "2 mm"], wheelbase = "1.55 m"}')
        self.assertAlmostEqual(near[1]["ackermann"], near[0]["ackermann"], delta=0.02 * abs(near[0]["ackermann"]))
        turn = (rows[2]["steer"] - rows[0]["steer"] + rows[2]["other_steer"] - rows[0]["other_steer"]) / 2
        self.assertAlmostEqual(rows[1]["steer_ratio"], abs(2 * math.pi * 30 / 85 / turn), delta=0.05 * rows[1]["steer_ratio"])

    def test_pictures_are_drawn(self):
        page = self.folder / "page.html"
        self.latsch("test", self.front, '{kind = "kinematics", from = "-30 mm", to = "30 mm", points = 21, rates = true}', "--html", page)
        for title in ("Toe and camber", "Height of the roll center", "Motion ratio", "Rates"):
            self.assertIn(title, page.read_text())

    # Steer by rack is a rotation about z over a displacement along y, so its sign is the same in all conventions, and
    # so is that of the caster angle.
    def test_signs_of_others(self):
        test = '{kind = "kinematics", travel = "10 mm", rack = "5 mm", anti_roll_bar = true}'
        iso, sae, adams = (self.rows(test, signs=view)[0] for view in ("iso", "sae", "adams"))
        changed = lambda row: {name for name in iso if row[name] != iso[name]}
        self.assertEqual({name: -value for name, value in iso.items() if name in changed(sae)}, {name: sae[name] for name in changed(sae)})
        for name in ("rack", "steer", "other_steer", "contact_y", "center_y", "center_z", "arb_angle", "arb_ratio", "axle_roll_center_y",
                     "roll_steer"):
            self.assertIn(name, changed(sae))
        for name in ("toe", "camber", "caster", "kpi", "steer_by_rack", "bump_steer", "track", "roll", "roll_center_height"):
            self.assertNotIn(name, changed(sae))
        self.assertTrue({"rack", "steer_by_rack", "contact_x", "contact_y", "roll"} <= changed(adams))
        self.assertFalse({"steer", "toe", "camber", "caster", "contact_z", "travel"} & changed(adams))
        page = self.folder / "page.html"
        self.latsch("test", self.front, '{kind = "kinematics", rack = ["-5 mm", "0 mm", "5 mm"]}', "--html", page, "--signs", "sae")
        self.assertIn("rack to the right [mm]", page.read_text())

    # The study identifies the height of the track rod's inner end from the bump steer that it causes.
    def test_hardpoints_are_variables_of_a_study(self):
        specimen = self.folder / "specimen.toml"
        shutil.copy(self.front, specimen)
        edit(specimen, (r'trackrod_inner = .*', 'trackrod_inner = ["1490 mm", "266.310 mm", "124.5 mm"]'))
        rows = self.rows(TRAVEL, specimen)
        (self.folder / "toe.csv").write_text("travel [m],toe [rad]\n" + "".join(f"{r['travel']},{r['toe']}\n" for r in rows))
        study = self.folder / "study.toml"
        study.write_text('title = "Bump steer"\nmodel = "race_car_front.toml"\n'
                         '[test.bump]\nkind = "kinematics"\ntravel = ["-20 mm", "0 mm", "20 mm"]\n'
                         '[variable.z]\npath = "hardpoint.trackrod_inner.2"\nlower = "110 mm"\nupper = "130 mm"\ninitial = "119.872 mm"\n'
                         '[measurement.rig]\nfile = "toe.csv"\n'
                         '[experiment.toe]\nkind = "curve"\nx = "bump/travel"\ny = "bump/toe"\nmeasurement = "rig"\n')
        text = self.latsch("run", study)
        found = re.search(r"\bz +([\d.]+) mm", text)
        self.assertTrue(found, text)
        self.assertAlmostEqual(float(found[1]), 124.5, delta=0.05)

    def test_what_is_no_suspension_is_refused_in_words(self):
        def refused(pattern, new, *parts):
            spoiled = self.folder / "spoiled.toml"
            shutil.copy(self.front, spoiled)
            edit(spoiled, (pattern, new))
            text = self.latsch("test", spoiled, TRAVEL, code=WRONG_INPUT)
            for part in ("spoiled.toml", *parts):
                self.assertIn(part, text)

        refused(r" mm\"", ' m"', "millimeters")
        refused(r'ubj = .*', 'ubj = ["1648.347 mm", "273.206 mm", "303.434 mm"]', "uca_front", "in one line")
        refused(r'trackrod_inner = .*', 'trackrod_inner = ["1490 mm", "553.4 mm", "118.54 mm"]', "trackrod", "coincide")
        refused(r'trackrod_outer = .*', 'trackrod_outer = ["1539.399 mm", "563.477 mm", "148.512 mm"]', "trackrod_outer is on the kingpin")
        refused(r'side = "left"', 'side = "right"', "side", "left is y > 0")
        refused(r'lbj = \["1539.399 mm", "563', 'lbj = ["1539.399 mm", "-563', "lca_front", "left is y > 0")
        refused(r'contact = .*', 'contact = ["1500 mm", "612.5 mm", "0 mm"]', "contact", "50 mm behind wheel_center")
        refused(r'contact = .*', 'contact = ["1550 mm", "612.5 mm", "300 mm"]', "contact is not below wheel_center")
        refused(r'rocker_pivot = .*\n', "", "rocker", "rocker_pivot")
        refused(r'rocker_pivot = .*', 'rocker_pivot = ["1507.720 mm", "191.715 mm", "544.030 mm"]', "rocker_pivot is in line")
        refused(r'\[hardpoint\]', '[hardpoint]\nwheel_centre = ["1 mm", "1 mm", "1 mm"]', "wheel_centre", "wheel_center")

    def test_what_is_no_test_is_refused_in_words(self):
        for test, part in (('{kind = "kinematics"}', "travel"), ('{kind = "kinematics", travel = []}', "is empty"),
                           ('{kind = "kinematics", travel = "1 kN"}', "travel"),
                           ('{kind = "kinematics", from = "10 mm", to = "-10 mm", points = 3}', "is not above from"),
                           ('{kind = "kinematics", travel = ["1 mm", "2 mm"], rack = ["1 mm", "2 mm", "3 mm"]}', "has 3 values, expected one or 2"),
                           ('{kind = "kinematics", travel = "1 mm", mode = "roll"}', "opposed"),
                           ('{kind = "kinematics", travel = "1 mm", brake_share = 0.5}', "cg_height"),
                           ('{kind = "kinematics", travel = "1 mm", wheelbase = "2 m"}', "rack")):
            self.assertIn(part, self.latsch("test", self.front, test, code=WRONG_INPUT))
        rear, lotus = self.folder / "race_car_rear.toml", self.folder / "lotus_bat.toml"
        self.assertIn("has no anti-roll bar", self.latsch("test", rear, '{kind = "kinematics", travel = "0 mm", anti_roll_bar = true}', code=WRONG_INPUT))
        self.assertIn("has no [spring]", self.latsch("test", lotus, '{kind = "kinematics", travel = "0 mm", rates = true}', code=WRONG_INPUT))
        self.assertIn("bushing", self.latsch("test", lotus, '{kind = "kc", Fz = "1 kN"}', code=WRONG_INPUT))

    def test_where_the_linkage_ends_is_named(self):
        text = self.latsch("test", self.front, '{kind = "kinematics", travel = ["0 mm", "400 mm"], at = "wheel_center"}', code=FAILED)
        self.assertRegex(text, r"state 2 of the kinematic rig: travel 400 mm .* cannot be reached: \w+ ends the path at \d+")
        text = self.latsch("test", self.front, '{kind = "kinematics", rack = "300 mm"}', code=FAILED)
        self.assertRegex(text, r"trackrod ends the path at .* with the rack at")


if __name__ == "__main__":
    unittest.main()
