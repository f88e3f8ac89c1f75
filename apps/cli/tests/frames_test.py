#!/usr/bin/env python3
"""Tests that a wheel's force and moment give the same measurement in whatever frame and sign convention a rig writes
them.

Forces and moments of a wheel are vectors in space here. Their components along the axes of a frame, about its origin
and in the signs of a convention, are written into a file, and the program has to find the vectors again in the frame
that the study asks for. A frame is given by its axes and origin in space: none of the program's formulas between two
frames is used.

   frames_test.py PATH/TO/latsch"""
import csv
import itertools
import json
import math
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT

FRAMES = "WHC"
FORCES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
TIR = """[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
[MODEL]
FITTYP = 61
LONGVL = 16.7
[DIMENSION]
UNLOADED_RADIUS = 0.32
[VERTICAL]
FNOMIN = 4000
VERTICAL_STIFFNESS = 200000
[COEFFICIENTS]
PCX1 = 1.6
PDX1 = 1.1
PKX1 = 20
PCY1 = 1.4
PDY1 = 1.0
PKY1 = -20
PKY2 = 1.8
"""
STUDY = """[model]
kind = "magic_formula"
file = "tire.tir"
[measurement.rig]
file = "rig.csv"
{measurement}
[test.sweep]
kind = "slip_sweep"
speed = "60 km/h"
load = "4 kN"
alpha = ["-2 deg", "2 deg"]
run_in = "0.1 s"
duration = "0.1 s"
sample_step = "5 ms"
frame = {frame}
[variable.grip]
path = "PDY1"
lower = 0.5
upper = 2
initial = 1
"""
EXPERIMENT = '[experiment.{0}]\nkind = "curve"\nx = "sweep/time"\ny = "sweep/{0}"\nmeasurement = "rig"\n'
TIMES = [0.16 + 0.01 * i for i in range(9)]


def dot(a, b):
    return math.fsum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class Wheel:
    """Samples of a wheel: camber, loaded radius, and the force and moment at its center, in axes that point forward,
    left and up."""

    def __init__(self, seed):
        chance = random.Random(seed)
        self.gamma = [chance.uniform(-0.15, 0.15) for _ in TIMES]
        self.R_l = [chance.uniform(0.28, 0.32) for _ in TIMES]
        self.force = [[chance.gauss(mean, 1500) for mean in (0, 0, 6000)] for _ in TIMES]
        self.moment = [[chance.gauss(0, 400) for _ in range(3)] for _ in TIMES]

    def frame(self, name, i):
        """Returns the axes and the origin of a frame in space; the top of the wheel leans to the right."""
        forward, left, up = [1, 0, 0], [0, 1, 0], [0, 0, 1]
        along_wheel = [0, -math.sin(self.gamma[i]), math.cos(self.gamma[i])]  # upward in the wheel plane
        if name == "C":
            return [forward, cross(along_wheel, forward), along_wheel], [0, 0, 0]
        return [forward, left, up], [0, 0, 0] if name == "H" else [-self.R_l[i] * x for x in along_wheel]

    def components(self, name):
        """Returns forces and moments in iso, one row for each sample."""
        rows = []
        for i, (force, moment) in enumerate(zip(self.force, self.moment)):
            axes, origin = self.frame(name, i)
            about = [m - c for m, c in zip(moment, cross(origin, force))]
            rows.append([dot(axis, force) for axis in axes] + [dot(axis, about) for axis in axes])
        return rows


def written(rows, convention):
    """Converts components to y to the right and z downward, except that adapted_sae has a positive load."""
    signs = {"iso": [1, 1, 1, 1, 1, 1], "sae": [1, -1, -1, 1, -1, -1], "adapted_sae": [1, -1, 1, 1, -1, -1]}[convention]
    return [[sign * x for sign, x in zip(signs, row)] for row in rows]


class Frames(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_frames_"))
        (self.base / "tire.tir").write_text(TIR)

    def tearDown(self):
        shutil.rmtree(self.base)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run

    def record(self, wheel, frame, convention="iso", without=(), suffix=""):
        columns = {"time [s]": TIMES, "gamma [deg]": map(math.degrees, wheel.gamma),
                   "RL [mm]": [1e3 * R for R in wheel.R_l]}
        for name, values in zip(FORCES, zip(*written(wheel.components(frame), convention))):
            columns[f"{name}{suffix} [{'N' if name[0] == 'F' else 'N m'}]"] = values
        kept = {name: values for name, values in columns.items() if name.split(" ")[0] not in without}
        (self.base / "rig.csv").write_text(
            "\n".join([",".join(kept), *(",".join(map(repr, row)) for row in zip(*kept.values()))]) + "\n")

    def study(self, measurement, frame, forces=FORCES):
        (self.base / "study.toml").write_text(STUDY.format(measurement=measurement, frame=frame) +
                                              "".join(EXPERIMENT.format(force) for force in forces))
        return self.base / "study.toml"

    def measured(self, study):
        answer = json.loads(self.latsch("simulate", study, "--json").stdout)["result"]
        return {e["name"]: e["curve"]["measured"] for e in answer["experiments"]}

    def assert_components(self, found, wheel, frame, forces=FORCES):
        expected = dict(zip(FORCES, zip(*wheel.components(frame))))
        self.assertEqual(set(found), set(forces))
        for force in forces:
            self.assert_close(found[force], expected[force], 1e-9, f"{force} in {frame}")

    def assert_close(self, found, expected, most, of=""):
        self.assertEqual(len(found), len(expected))
        self.assertLess(max(abs(a - b) for a, b in zip(found, expected)), most, of)

    def test_every_frame_and_convention_becomes_every_frame(self):
        for seed, (convention, source, target) in enumerate(
                itertools.product(("iso", "adapted_sae", "sae"), FRAMES, FRAMES)):
            with self.subTest(convention=convention, source=source, target=target):
                wheel = Wheel(seed)
                self.record(wheel, source, convention)
                study = self.study(f'axes = "{convention}"\nframe = "{source}"\nin_frame = "{target}"', f'"{target}"')
                self.assert_components(self.measured(study), wheel, target)

    def test_names_say_the_frame_as_a_table_does(self):
        wheel = Wheel(1)
        self.record(wheel, "C", "sae", suffix="C")
        self.assert_components(self.measured(self.study('axes = "sae"\nin_frame = "W"', '"W"')), wheel, "W")

    def test_a_test_of_several_frames_is_compared_in_that_of_the_measurement(self):
        wheel = Wheel(2)
        for frame in FRAMES:
            self.record(wheel, frame, suffix=frame)
            self.assert_components(self.measured(self.study("", '["C", "W", "H"]')), wheel, frame)
        tested = self.latsch("test", self.base / "tire.tir", '{kind = "slip_sweep", speed = "60 km/h", load = "4 kN", '
                             'alpha = ["0 deg", "2 deg"], camber = "5 deg", frame = ["C", "W"]}').stdout
        head = [cell.split(" ")[0] for cell in
                next(line for line in tested.splitlines() if line.startswith("time")).split(",")]
        rows = [[float(x) for x in line.split(",")] for line in tested.splitlines() if line[:1].isdigit()]
        columns = dict(zip(head, zip(*rows)))
        c, s = math.cos(math.radians(5)), math.sin(math.radians(5))
        self.assert_close([c * y - s * z for y, z in zip(columns["FyC"], columns["FzC"])], columns["FyW"], 1e-6)
        self.assert_close([s * y + c * z for y, z in zip(columns["FyC"], columns["FzC"])], columns["FzW"], 1e-6)

    def test_show_says_what_was_turned_by_which_formula(self):
        self.record(Wheel(3), "H")
        study = self.study('frame = "H"\nin_frame = "W"', '"W"')
        shown = self.latsch("show", study, "--html", self.base / "shown.html").stdout
        self.assertIn("Fx, Fy, Fz, Mx, My, Mz turned from axes H into W: F_W = F_H, M_W = M_H - r x F_H, "
                      "r = R_l (0, sin gamma, -cos gamma), R_l the loaded_radius", shown)

    def test_what_a_component_lacks_is_said(self):
        wheel = Wheel(4)
        self.record(wheel, "H", without=("Fx",))
        turn = 'frame = "H"\nin_frame = "W"'
        self.assert_components(self.measured(self.study(turn, '"W"', ("Fy", "Fz", "Mx"))), wheel, "W",
                               ("Fy", "Fz", "Mx"))
        refused = self.latsch("check", self.study(turn, '"W"', ("Mz",)), code=WRONG_INPUT).stderr
        self.assertIn('column "Mz" cannot be turned from axes H into W without Fx', refused)
        self.assertIn("My is left out: it cannot be turned", self.latsch("show", self.base / "study.toml").stdout)
        self.record(wheel, "C", without=("gamma",))
        refused = self.latsch("check", self.study('frame = "C"\nin_frame = "W"', '"W"', ("Fy",)),
                              code=WRONG_INPUT).stderr
        self.assertIn('column "Fy" cannot be turned from axes C into W without gamma', refused)
        self.record(wheel, "H", without=("Fx", "Fy", "Fz", "gamma", "RL"))
        refused = self.latsch("check", self.study(turn, '"W"', ("Mx",)), code=WRONG_INPUT).stderr
        self.assertIn("measurement.rig.in_frame", refused)
        self.assertIn("Mx cannot be turned from axes H into W without Fy and Fz and gamma and loaded_radius", refused)
        self.record(wheel, "H")
        refused = self.latsch("check", self.study('in_frame = "W"', '"W"', ("Mx",)), code=WRONG_INPUT).stderr
        self.assertIn("the axes of the recorded forces are not stated", refused)

    def test_other_axes_are_refused_with_both_ways_out(self):
        self.record(Wheel(5), "C")
        refused = self.latsch("check", self.study('frame = "C"', '"W"', ("Fy",)), code=WRONG_INPUT).stderr
        self.assertIn('put in_frame = "W" into [measurement.rig]', refused)
        self.assertIn('frame = "C" into [test.sweep] or its file', refused)

    def test_frames_of_a_test_are_named_once_each(self):
        self.record(Wheel(5), "C")
        for frame, expected in (('["C", "C"]', 'has "C" twice'), ('["X"]', 'has "X", expected "W", "H" or "C"'),
                                ("[]", "is empty"), ("3", "is no frame")):
            refused = self.latsch("check", self.study('frame = "C"', frame, ("Fy",)), code=WRONG_INPUT).stderr
            self.assertIn(expected, refused)
        refused = self.latsch("check", self.study("", '["C", "W"]', ("Fy",)), code=WRONG_INPUT).stderr
        self.assertIn('recorded in several axes, "sweep/FyC" or "sweep/FyW": name one of them', refused)

    def test_a_twin_of_what_was_turned_stands_in_the_frame_of_the_file(self):
        for convention, frame, suffix in (("iso", "H", ""), ("sae", "C", ""), ("adapted_sae", "C", "C")):
            with self.subTest(convention=convention, frame=frame, suffix=suffix):
                wheel = Wheel(7)
                self.record(wheel, frame, convention, suffix=suffix)
                stated = "" if suffix else f'frame = "{frame}"\n'
                study = self.study(f'axes = "{convention}"\n{stated}in_frame = "W"', '"W"', ("Fy", "Fz", "Mx"))
                self.latsch("export", study, "--measurements")
                with open(self.base / "rig.csv") as file:
                    self.assertTrue(next(file).startswith("# Not measured"))
                    rows = list(csv.DictReader(file))
                # In the study's test the wheel is upright and has another radius. The forces of the file must be
                # converted with the camber and radius of the file.
                answer = json.loads(self.latsch("simulate", study, "--json").stdout)["result"]["experiments"]
                simulated = {e["name"]: e["curve"]["simulated"] for e in answer}
                for i, row in enumerate(rows):
                    signed = [float(row[f"{name}{suffix} [{'N' if name[0] == 'F' else 'N m'}]"]) for name in FORCES]
                    wrench = written([signed], convention)[0]  # the conversion is its own inverse
                    axes, origin = wheel.frame(frame, i)
                    force = [sum(axis[k] * F for axis, F in zip(axes, wrench)) for k in range(3)]
                    moment = [sum(axis[k] * M for axis, M in zip(axes, wrench[3:])) for k in range(3)]
                    contact = wheel.frame("W", i)[1]
                    arm = [a - b for a, b in zip(origin, contact)]
                    about = [m + c for m, c in zip(moment, cross(arm, force))]
                    self.assertAlmostEqual(force[1], simulated["Fy"][i], delta=1e-6)
                    self.assertAlmostEqual(force[2], simulated["Fz"][i], delta=1e-6)
                    self.assertAlmostEqual(about[0], simulated["Mx"][i], delta=1e-6)
                for experiment in answer:
                    self.assert_close(experiment["curve"]["measured"], experiment["curve"]["simulated"], 1e-9)

    def test_a_twin_that_cannot_be_turned_back_is_refused(self):
        file = self.base / "rig.csv"
        file.write_text("deflection [mm],gamma [deg],Fy [N],Fz [N]\n5,2,30,1000\n10,2,60,2000\n")
        study = self.study('frame = "C"\nin_frame = "W"', '"W"', ())
        head, rest = study.read_text().split("[test.sweep]")
        study.write_text(head + '[variable' + rest.split('[variable')[1].replace("PDY1", "VERTICAL_STIFFNESS").replace(
            "lower = 0.5\nupper = 2\ninitial = 1", 'lower = "100 N/mm"\nupper = "300 N/mm"\ninitial = "200 N/mm"') +
            '[experiment.pressed]\nkind = "load_deflection"\nmeasurement = "rig"\n')
        before = file.read_text()
        refused = self.latsch("export", study, "--measurements", code=WRONG_INPUT).stderr
        self.assertIn("measurement.rig cannot be written by a twin: Fy is not recorded by the test", refused)
        self.assertEqual(file.read_text(), before)

    def test_loads_of_states_are_those_of_the_road(self):
        wheel = Wheel(6)
        self.record(wheel, "C")
        states = STUDY.format(measurement='frame = "C"{}', frame='"W"').split("[test.sweep]")
        study = self.base / "study.toml"
        steady = ('[test.steady]\nkind = "steady_states"\nstates = {{from = "measurement.rig"}}\n[variable.grip]\n'
                  'path = "PDY1"\nlower = 0.5\nupper = 2\ninitial = 1\n[experiment.load]\nkind = "curve"\n'
                  'y = "steady/Fz"\nmeasurement = "rig"\n')
        study.write_text((states[0] + steady).format(""))
        self.assertIn('put in_frame = "W" into [measurement.rig]',
                      self.latsch("check", study, code=WRONG_INPUT).stderr)
        # A test without the key frame is not offered it. The load is the same in axes H and W, a moment is not.
        self.record(wheel, "H")
        moment = (states[0].replace('"C"', '"H"') + steady.replace("steady/Fz", "steady/Mx")).format("")
        study.write_text(moment)
        refused = self.latsch("check", study, code=WRONG_INPUT).stderr
        self.assertIn('put in_frame = "W" into [measurement.rig]', refused)
        self.assertNotIn('frame = "H" into', refused)
        self.record(wheel, "C")
        study.write_text((states[0] + steady).format('\nin_frame = "W"'))
        answer = json.loads(self.latsch("simulate", study, "--json").stdout)["result"]["experiments"][0]["curve"]
        for kind in ("measured", "simulated"):
            self.assert_close(answer[kind], [force[2] for force in wheel.force], 1e-9)


if __name__ == "__main__":
    unittest.main()
