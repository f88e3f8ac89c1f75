#!/usr/bin/env python3
"""Tests a corner of a suspension on the K&C rig: published static values, identified bushings, and refused input.

   kc_test.py PATH/TO/latsch"""
import csv
import io
import math
import pathlib
import re
import shutil
import subprocess
import tempfile
import tomllib
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, edit

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies" / "compliance"


class Kc(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_kc_"))
        self.addCleanup(shutil.rmtree, self.folder)
        for file in STUDIES.glob("*.toml"):
            shutil.copy(file, self.folder)
        self.corner = self.folder / "front_left.toml"

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout + run.stderr

    def rows(self, test, corner=None, signs="iso"):
        table = csv.reader(io.StringIO(self.latsch("test", corner or self.corner, test, "--signs", signs)))
        names = [name.split(" [")[0] for name in next(table)]
        return [dict(zip(names, map(float, (x or "nan" for x in row)))) for row in table]

    def test_it_moves_as_published(self):  # the published figures are those in corner_test.cpp
        row = self.rows('{kind = "kc", Fy = "-4 kN"}')[0]
        for name, value in {"dx": 0.02265e-3, "dy": -0.56246e-3, "dz": -0.16064e-3}.items():
            self.assertAlmostEqual(row[name], value, delta=0.5e-8)
        for name, value in {"camber": 0.07710, "toe": 0.33106, "caster": -0.02222}.items():
            self.assertAlmostEqual(math.degrees(row[name]), value, delta=0.5e-5)

    def test_slopes_are_those_of_a_line_through_what_moves(self):
        loads = ["0 N", "1 kN", "2 kN", "3 kN", "4 kN"]
        listed = ", ".join(f'"{load}"' for load in loads)
        rows = self.rows(f'{{kind = "kc", Fz = [{listed}], slopes_by = "Fz", window = ["0.9 kN", "3.1 kN"]}}')
        dz = [row["dz"] for row in rows]
        self.assertAlmostEqual(rows[0]["dz_by_Fz"] / ((dz[3] - dz[1]) / 2000.0), 1.0, delta=1e-9)

    # Force times travel is work in any axes, so both change sign together. In sae and adams y points to the right,
    # and a force of -4 kN along y becomes +4 kN; toe, camber and caster have the same sign.
    def test_signs_of_others_are_those_of_their_axes(self):
        test = '{kind = "kc", Fx = "1 kN", Fy = "-4 kN", Fz = "2 kN", Mz = "100 N m"}'
        iso = self.rows(test)[0]
        for view, signs in (("iso", {}), ("sae", {"y": -1, "z": -1}), ("adams", {"x": -1, "y": -1})):
            row = self.rows(test, signs=view)[0]
            for axis in "xyz":
                for name in ("F" + axis, "d" + axis):
                    self.assertEqual(row[name], signs.get(axis, 1) * iso[name], f"{view} {name}")
            for name in ("camber", "toe", "caster"):
                self.assertEqual(row[name], iso[name])
            self.assertEqual(row["Mz"], 100.0 if view != "sae" else -100.0)
        for view, signs in (("sae", (1, -1, -1, 1, -1, -1)), ("adams", (-1, -1, 1, -1, -1, 1))):
            C, viewed = self.matrix(test), self.matrix(test, "--signs", view)
            for i in range(36):
                self.assertEqual(viewed[i], signs[i // 6] * signs[i % 6] * C[i], f"{view} {i}")

    def test_signs_are_refused_where_a_test_has_none(self):
        tire = STUDIES.parent / "tires" / "passenger_205_55R16.toml"
        text = self.latsch("test", tire, '{kind = "footprint", loads = ["4 kN"]}', "--signs", "sae", code=WRONG_INPUT)
        self.assertIn("kinematics", text)
        self.latsch("test", self.corner, '{kind = "kc", Fy = "-4 kN"}', "--signs", "din", code=WRONG_INPUT)

    def matrix(self, test, *more):
        details = self.folder / "details.csv"
        self.latsch("test", self.corner, test, "--details", details, *more)
        return [float(value) for value in list(csv.reader(io.StringIO(details.read_text())))[1]]

    def test_the_compliance_matrix_of_a_state_is_its_slope(self):
        details = self.folder / "compliance.csv"
        self.latsch("test", self.corner, '{kind = "kc", Fy = "-2 kN"}', "--details", details)
        names, values = csv.reader(io.StringIO(details.read_text()))
        C = {name.split(" [")[0]: float(value) for name, value in zip(names, values)}
        self.assertEqual(len(C), 36)
        rows = self.rows('{kind = "kc", Fy = ["-2.01 kN", "-1.99 kN"]}')
        for name in ("dx", "dy", "dz"):
            self.assertAlmostEqual(C[f"{name}_by_Fy"] / ((rows[1][name] - rows[0][name]) / 20.0), 1.0, delta=1e-4)

    def test_at_the_wheel_center_a_side_force_does_not_tilt_it_by_its_height(self):
        patch = self.rows('{kind = "kc", Fy = "100 N"}')[0]
        center = self.rows('{kind = "kc", Fy = "100 N", at = "wheel_center"}')[0]
        # The force Fy acts 235 mm higher and the moment Mx compensates for it.
        moved = self.rows('{kind = "kc", Fy = "100 N", Mx = "-23.5 N m", at = "contact_patch"}')[0]
        self.assertNotAlmostEqual(patch["camber"], center["camber"], delta=1e-6)
        for angle in ("camber", "toe", "caster"):
            self.assertAlmostEqual(moved[angle], center[angle], delta=1e-3 * abs(center[angle]))

    def test_bushings_are_found_and_what_is_not_measured_is_said(self):
        text = self.latsch("run", self.folder / "study.toml")
        self.assertIn("Levenberg-Marquardt", text)
        truth = tomllib.loads((self.folder / "specimen.toml").read_text())["bushing"]
        for joint in ("uca_front", "uca_rear", "lca_front", "lca_rear", "ubj", "lbj"):
            found = re.search(rf"{joint} +([\d.]+) kN/mm +95 %: ([\d.]+) \.\. ([\d.]+)", text)
            self.assertTrue(found, f"{joint}: {text}")
            value, low, high = map(float, found.groups())
            stiffness = float(truth[joint]["x"].split()[0])
            self.assertAlmostEqual(value / stiffness, 1.0, delta=1e-3, msg=joint)
            self.assertLess(low, stiffness)
            self.assertGreater(high, stiffness)
        for end in ("pushrod_inner", "pushrod_outer", "trackrod_inner", "trackrod_outer"):
            self.assertRegex(text, rf"{end} .*anywhere between the bounds")
        # The data determine only the series stiffness of the bushings at both ends of a rod: each end is at least as
        # stiff as the series, whatever the stiffness of the other end.
        profiles = self.latsch("identify", self.folder / "study.toml").split("Profiles:")[1].split("Cross-validation")[0]
        self.assertNotIn("several minima", profiles)
        for rod in ("pushrod", "trackrod"):
            inner, outer = (float(truth[f"{rod}_{end}"]["x"].split()[0]) for end in ("inner", "outer"))
            limit = 1.0 / (1.0 / inner + 1.0 / outer - 1.0 / 400.0)  # if the other end is at its upper bound
            for end in ("inner", "outer"):
                found = re.search(rf"{rod}_{end} +one-sided.*\n +95 %: at least ([\d.]+)", profiles)
                self.assertTrue(found, profiles)
                self.assertAlmostEqual(float(found[1]) / limit, 1.0, delta=0.05)
        self.assertIn("All of them agree", self.latsch("check", "--derivatives", self.folder / "study.toml"))

    def test_a_prior_holds_what_the_numbers_leave_open_and_the_next_load_case_is_named(self):
        study = self.folder / "axes.toml"
        self.latsch("run", study)
        text = self.latsch("identify", study)
        self.assertIn("from 16 measured values and 30 priors", text)
        truth = tomllib.loads((self.folder / "specimen.toml").read_text())["bushing"]
        # each error is below two standard deviations
        for joint, axis in ((j, a) for j in truth if j != "all" for a in "xyz"):
            found = re.search(rf"{joint}_{axis} +[\d.]+ kN/mm +95 %: ([\d.]+) \.\. ([\d.]+)", text)
            self.assertTrue(found, f"{joint}_{axis}: {text}")
            self.assertLess(float(found[1]), float(truth[joint][axis].split()[0]), f"{joint}_{axis}")
            self.assertGreater(float(found[2]), float(truth[joint][axis].split()[0]), f"{joint}_{axis}")
        gains = text.split("experiments that are only predicted so far")[1].split("Computed values")[0]
        self.assertRegex(gains, r"test G, all of it +1 / [\d.]+")
        # A whole load case gives at least as much information as one of its values.
        gain = {name: float(value) for name, value in re.findall(r"\n  (\S.*?) +1 / ([\d.]+)", gains)}
        self.assertGreaterEqual(gain["test G, all of it"], gain["G_caster"])

    def test_pattern_search_flags_what_it_hardly_weighs(self):
        study = self.folder / "thesis.toml"
        study.write_text(study.read_text().replace("max_steps = 50000", "max_steps = 60"))
        self.latsch("run", study)
        page = (self.folder / "thesis.html").read_text()
        values = page.split('<section id="values">')[1].split("</section>")[0]
        for name, flagged in (("A_toe", True), ("B_caster", True), ("D_dz", True), ("D_caster", True), ("A_dz", False)):
            row = values.split(f"<tr><td>{name}<")[1].split("</tr>")[0]
            self.assertEqual("weight near zero" in row, flagged, row)
        self.assertIn("hardly affects the fit", values)
        self.assertNotIn('id="curves"', page)  # a single value is not drawn

    def test_a_recording_of_a_rig_drives_the_test(self):
        (self.folder / "rig.csv").write_text("Fz [kN],Fx [N],dz [mm]\n0,0,0\n2,-100,0.5\n4,-200,1.0\n")
        study = self.folder / "study.toml"
        study.write_text('model = "front_left.toml"\n[measurement.rig]\nfile = "rig.csv"\n'
                         '[test.rig]\nkind = "kc"\nloads = {from = "measurement.rig"}\n'
                         '[variable.all]\npath = "bushing.all.x"\nlower = "5 kN/mm"\nupper = "80 kN/mm"\n'
                         'initial = "30 kN/mm"\n'
                         '[experiment.dz]\nkind = "curve"\nx = "rig/Fz"\ny = "rig/dz"\nmeasurement = "rig"\n')
        text = self.latsch("check", study)
        self.assertIn("Fx, Fz at the contact patch, 3 states", text)
        self.latsch("run", study)

    def test_what_is_no_suspension_is_refused_in_words(self):
        def refused(pattern, new, *parts):
            spoiled = self.folder / "spoiled.toml"
            shutil.copy(self.corner, spoiled)
            edit(spoiled, (pattern, new))
            text = self.latsch("test", spoiled, '{kind = "kc", Fz = "1 kN"}', code=WRONG_INPUT)
            for part in ("spoiled.toml", *parts):
                self.assertIn(part, text)

        refused(r'"1510.800 mm", "527.786 mm", "350.000 mm"', '"1510.8 m", "527.786 m", "350 m"', "ubj", "millimeters")
        refused(r'ubj = \["1510.800 mm", "527.786 mm", "350.000 mm"\]', 'ubj = ["1648.347 mm", "273.206 mm", "303.434 mm"]',
                "in one line", "uca_front")
        refused(r'side = "left"', 'side = "right"', "side", "left is y > 0")
        refused(r'z = "30 kN/mm"\n', "", "has no z", "bushing.all")
        refused(r'([xyz]) = "30 kN/mm"', r'\1 = "0 kN/mm"', "has no stiffness", "uca_front")
        refused(r'(about_[xyz]) = "200 N m/rad"', r'\1 = "0 N m/rad"', "the push-rod spins freely", "no rotational stiffness", "about_x")
        refused(r'x = "30 kN/mm"', 'x = "-30 kN/mm"', "x")
        refused(r'pushrod_inner = .*', 'pushrod_inner = ["1507.720 mm", "273.296 mm", "307.192 mm"]', "the push-rod points at the axis",
                "uca_front to uca_rear")
        refused(r'trackrod_inner = .*', 'trackrod_inner = ["1413.012 mm", "568.983 mm", "-157.502 mm"]', "the track-rod points at the kingpin")
        refused(r'x = "30 kN/mm"', 'curve.x = [["-1 mm", "-9 kN"], ["1 mm", "9 kN"], ["0.5 mm", "3 kN"]]', "bushing.all.curve.x does not rise in x")
        refused(r"\[bushing.all\]", '[bushing.ubk]\nx = "1 kN/mm"\n[bushing.all]', "ubk", "ubj")

    def test_what_is_no_test_is_refused_in_words(self):
        for test, part in (('{kind = "kc"}', "Fz"), ('{kind = "kc", Fzz = "1 N"}', 'did you mean "Fz"'), ('{kind = "kc", Fz = []}', "is empty"),
                           ('{kind = "kc", slopes_by = "Fz"}', "Fz is missing"),
                           ('{kind = "kc", Fz = ["1 kN", "2 kN"], Fx = ["1 N", "2 N", "3 N"]}', "expected one or 3"),
                           ('{kind = "kc", Fz = ["1 kN", "1 kN"], slopes_by = "Fz"}', "does not vary"),
                           ('{kind = "kc", Fz = "1 kN", window = ["0 N", "1 N"]}', "slopes_by"),
                           ('{kind = "kc", Mz = "1 kN"}', "N m")):
            self.assertIn(part, self.latsch("test", self.corner, test, code=WRONG_INPUT))
        tire = STUDIES.parent / "ring_tires" / "passenger_205_55R16.toml"
        self.assertIn("is loaded on a K&C rig", self.latsch("test", tire, '{kind = "kc", Fz = "1 kN"}', code=WRONG_INPUT))

    def test_a_load_beyond_it_fails_and_names_the_joint(self):
        text = self.latsch("test", self.corner, '{kind = "kc", Mz = "150 kN m"}', code=FAILED)
        self.assertIn("no equilibrium beyond", text)
        self.assertIn("is turned most", text)
        edit(self.corner, ("30 kN/mm", "5 kN/mm"))
        text = self.latsch("test", self.corner, '{kind = "kc", Fz = "200 kN"}', code=FAILED)
        self.assertRegex(text, r"the bushing \w+ is stretched by [\d.]+ mm")

    def test_newtons_by_meter_as_by_millimeter_name_the_bushing(self):
        edit(self.corner, ("30 kN/mm", "30 kN/m"))
        text = self.latsch("test", self.corner, '{kind = "kc", Fz = "2 kN"}', code=FAILED)
        self.assertRegex(text, r"state 1 of the K&C rig: the bushing \w+ is stretched by [\d.]+ mm.*N/m that should be N/mm")


if __name__ == "__main__":
    unittest.main()
