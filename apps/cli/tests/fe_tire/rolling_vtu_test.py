#!/usr/bin/env python3
"""Tests the ParaView files of a finite-element tire that rolls against the tables of the same states.

   rolling_vtu_test.py PATH/TO/latsch"""
import csv
import io
import math
import pathlib
import sys
import unittest
import xml.etree.ElementTree as tree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import WRONG_INPUT, Coarse

STATE = 'load = "2 kN", speed = "60 km/h", alpha = "2 deg", camber = "3 deg"'


class Vtu:
    def __init__(self, file):
        root = tree.parse(file).getroot()
        piece = root.find("UnstructuredGrid/Piece")
        self.points, self.cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))
        self.arrays = {array.get("Name"): array for array in root.iter("DataArray")}

    def __getitem__(self, name):
        """The values of an array, a tuple for each point or cell if they have components."""
        array = self.arrays[name]
        values = [float(value) for value in array.text.split()]
        width = int(array.get("NumberOfComponents", "1"))
        return values if width == 1 else list(zip(*[iter(values)] * width))


class RollingVtu(Coarse):
    def table(self, kind, more, *options):
        keys = '{kind = "%s", %s%s}' % (kind, STATE, more)
        file = self.folder / (kind + ".csv")
        self.latsch("test", self.folder / "tire.toml", keys, *options, file)
        rows = list(csv.reader(io.StringIO(file.read_text())))
        return {head.split(" [")[0]: [float(row[k]) for row in rows[1:]] for k, head in enumerate(rows[0])}

    def export(self, kind, more="", name="rolling.vtu"):
        keys = '{kind = "%s", %s%s}' % (kind, STATE, more)
        return self.latsch("export", self.folder / "tire.toml", "--vtu", self.folder / name, "--rolling", keys)

    def close(self, found, expected, what):
        most = max(abs(value) for value in expected)
        self.assertEqual(len(found), len(expected), what)
        for one, other in zip(found, expected):
            self.assertAlmostEqual(one, other, delta=2e-6 * most, msg=what)

    def test_the_patch_has_the_values_of_the_table_and_its_forces(self):
        self.export("rolling_footprint")
        patch = Vtu(self.folder / "rolling.patch.vtu")
        points = self.table("rolling_footprint", "", "--details")
        for name, key in (("p [Pa]", "pressure"), ("t_x [Pa]", "shear_x"), ("t_y [Pa]", "shear_y"), ("w_x [m/s]", "slide_x"),
                          ("w_y [m/s]", "slide_y"), ("grip", "grip"), ("power [W/m^2]", "power")):
            self.close(patch[name], points[key], name)
        self.close(patch["sliding speed [m/s]"], [math.hypot(*w) for w in zip(points["slide_x"], points["slide_y"])], "speed")
        load = sum(p * a for p, a in zip(patch["p [Pa]"], patch["area [m^2]"]))
        self.assertAlmostEqual(load, 2000, delta=0.1)
        # Vectors are in the wheel's axes, which the camber turns: their lengths are those of the table, and all lie
        # in one plane, whose normal has the camber.
        for shear, x, y in zip(patch["shear [Pa]"], points["shear_x"], points["shear_y"]):
            self.assertAlmostEqual(math.hypot(*shear), math.hypot(x, y), delta=1.0)
            self.assertAlmostEqual(shear[2], -math.tan(math.radians(3)) * shear[1], delta=1e-3 * math.hypot(x, y) + 1.0)
        rolling = self.table("rolling", "", "-o")
        self.assertAlmostEqual(sum(t * a for t, a in zip(patch["t_y [Pa]"], patch["area [m^2]"])), rolling["Fy"][0], delta=0.1)

    def test_the_chain_has_the_values_of_the_table(self):
        places = ', position = [0, 0.4], depth = "outer"'
        said = self.export("rolling_chain", places)
        self.assertIn("rolling.chain.vtu", said)
        chain, table = Vtu(self.folder / "rolling.chain.vtu"), self.table("rolling_chain", places, "-o")
        self.assertEqual(chain.cells, 2)
        for name, keys in (("points", "x y z"), ("displacement", "u_x u_y u_z"), ("velocity [m/s]", "v_x v_y v_z"),
                           ("acceleration [m/s^2]", "a_x a_y a_z"), ("theta [rad]", "theta"), ("position", "position"),
                           ("E (rr, tt, yy, 2rt, 2ty, 2ry)", "E_rr E_tt E_yy G_rt G_ty G_ry"),
                           ("S (rr, tt, yy, rt, ty, ry) [Pa]", "S_rr S_tt S_yy S_rt S_ty S_ry"),
                           ("energy [J/m^3]", "energy"), ("dissipation [W/m^3]", "dissipation")):
            keys = keys.split()
            for k, key in enumerate(keys):
                found = [value[k] for value in chain[name]] if len(keys) > 1 else chain[name]
                self.close(found, table[key], name + key)

    def test_the_ring_rolls(self):
        said = self.export("rolling")
        self.assertIn("rolling.vtu", said)
        self.assertFalse((self.folder / "rolling.chain.vtu").exists())
        ring, state = Vtu(self.folder / "rolling.vtu"), self.table("rolling", "", "-o")
        omega = state["omega"][0]
        X, u, v = ring["points"], ring["displacement"], ring["velocity [m/s]"]
        # The rim holds the beads: their nodes turn as a rigid body, with omega e_y x X.
        held = [k for k in range(ring.points) if math.hypot(*u[k]) == 0.0]
        self.assertGreater(len(held), 10)
        for k in held:
            for found, rigid in zip(v[k], (omega * X[k][2], 0.0, -omega * X[k][0])):
                self.assertAlmostEqual(found, rigid, delta=0.02 * omega * 0.3)
        # The lowest tread stands nearly still over the ground, which passes at the speed of the wheel.
        lowest = min(range(ring.points), key=lambda k: X[k][2] + u[k][2])
        self.assertAlmostEqual(v[lowest][0], -60 / 3.6, delta=1.5)
        # The strain energy and the work of the patch's points are numbers of every element.
        self.assertEqual(len(ring["E (rr, tt, yy, 2rt, 2ty, 2ry)"]), ring.cells)
        self.assertTrue(all(value >= 0.0 for value in ring["energy [J/m^3]"]))
        # The patch lies on the tread: every point has a node of the deformed ring within an element's length.
        for x in Vtu(self.folder / "rolling.patch.vtu")["points"]:
            gap = min(sum((X[k][i] + u[k][i] - x[i]) ** 2 for i in range(3)) for k in range(ring.points))
            self.assertLess(math.sqrt(gap), 0.03)

    def test_a_patch_on_a_drum_lies_on_it(self):
        keys = '{kind = "%s", load = "4 kN", speed = "60 km/h", alpha = "3 deg", drum_radius = "0.3 m"}'
        self.latsch("export", self.folder / "tire.toml", "--vtu", self.folder / "drum.vtu", "--rolling", keys % "rolling")
        file = self.folder / "state.csv"
        self.latsch("test", self.folder / "tire.toml", keys % "rolling", "-o", file)
        head, row = list(csv.reader(io.StringIO(file.read_text())))
        R_l = float(row[head.index("R_l [m]")])
        patch, turn = Vtu(self.folder / "drum.patch.vtu"), math.radians(3)
        for x, shear in zip(patch["points"], patch["shear [Pa]"]):
            # The drum's axis is across the wheel's velocity, R + R_l below its center.
            out = (math.cos(turn) * x[0] + math.sin(turn) * x[1], x[2] + R_l + 0.3)
            self.assertAlmostEqual(math.hypot(*out), 0.3, delta=1e-6)
            # Shear is along the drum's surface.
            along = math.cos(turn) * shear[0] + math.sin(turn) * shear[1]
            self.assertAlmostEqual(out[0] * along + out[1] * shear[2], 0.0, delta=1.0)

    def test_several_states_are_numbered(self):
        keys = '{kind = "rolling", load = ["2 kN", "3 kN"], speed = "60 km/h"}'
        said = self.latsch("export", self.folder / "tire.toml", "--vtu", self.folder / "both.vtu", "--rolling", keys)
        for name in ("both_1.vtu", "both_1.patch.vtu", "both_2.vtu", "both_2.patch.vtu"):
            self.assertIn(name, said)
            self.assertGreater(Vtu(self.folder / name).points, 10)

    def test_what_does_not_roll_is_refused(self):
        tire, vtu = self.folder / "tire.toml", self.folder / "no.vtu"
        rolling = '{kind = "rolling", load = "2 kN", speed = "60 km/h"}'
        for arguments, *parts in ((["--vtu", vtu, "--rolling", '{kind = "modes"}'], "rolling_footprint"),
                                  (["--vtu", vtu, "--rolling", rolling, "--deflection", "5 mm"], "--deflection"),
                                  (["--rolling", rolling], "--vtu")):
            said = self.latsch("export", tire, *arguments, code=WRONG_INPUT)
            for part in parts:
                self.assertIn(part, said)
        self.assertFalse(vtu.exists())


if __name__ == "__main__":
    unittest.main()
