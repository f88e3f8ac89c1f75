#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Computes inflation and modes of tire.toml with CalculiX, with every ply as a layer of solid elements. The model is
one sector of the tire, one quadratic element (C3D20R) wide, with cyclic symmetry. Every ply is a row of anisotropic
elements of finite thickness, with the stiffness of its rubber and E t / thickness along the cords, so that the rubber
between two plies shears as a continuum does. It shares only the numbers of tire.toml with our program.

   make_figures.py            all figures, as in figures.csv (some ten minutes)
   make_figures.py --deck 22 0.4 120 > deck.inp"""
import math
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
SECTORS = 120
HARMONICS = 1  # largest number of waves around the tire
MODES = 4  # number of modes for each number of waves


def number(text):
    value, _, unit = str(text).partition(" ")
    return float(value) * {"": 1, "mm": 1, "mm^2": 1, "MPa": 1, "GPa": 1e3, "bar": 0.1, "deg": 1,
                           "kg/m^3": 1e-12}[unit]


class Wall:
    """The cross section of the tire: a natural cubic spline over the chord length, parametrized by its arc length."""

    def __init__(self, section):
        half = np.array(section["contour"]["values"], float)
        points = np.vstack([half[:0:-1], half * [-1, 1]])  # order: bead at +y to bead at -y
        t = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        n = len(t)
        h = np.diff(t)
        A = np.eye(n)
        rhs = np.zeros((n, 2))
        for i in range(1, n - 1):
            A[i, i - 1:i + 2] = h[i - 1], 2 * (h[i - 1] + h[i]), h[i]
            rhs[i] = 6 * ((points[i + 1] - points[i]) / h[i] - (points[i] - points[i - 1]) / h[i - 1])
        self.t, self.p, self.m, self.h = t, points, np.linalg.solve(A, rhs), h
        fine = np.linspace(0, t[-1], 20001)
        at = self.spline(fine)
        arc = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(at, axis=0).T))])
        self.fine, self.arc = fine, 2 * arc / arc[-1] - 1
        self.length = arc[-1]
        self.profiles = [np.array([[r[0], number(r[1])] for r in section["thickness_" + side]])
                         for side in ("inside", "outside")]

    def spline(self, t, derivative=False):
        i = np.clip(np.searchsorted(self.t, t, side="right") - 1, 0, len(self.h) - 1)
        a = (self.t[i + 1] - t)[:, None]
        b = (t - self.t[i])[:, None]
        h = self.h[i][:, None]
        p, q, m, k = self.p[i], self.p[i + 1], self.m[i], self.m[i + 1]
        if derivative:
            return (-m * a**2 + k * b**2) / (2 * h) + (q / h - k * h / 6) - (p / h - m * h / 6)
        return (m * a**3 + k * b**3) / (6 * h) + (p / h - m * h / 6) * a + (q / h - k * h / 6) * b

    def at(self, s, d):
        """Returns (y, r) at the position s in [-1, 1] and the offset d outward, and the unit tangent."""
        t = np.atleast_1d(np.interp(s, self.arc, self.fine))
        p, tangent = self.spline(t)[0], self.spline(t, True)[0]
        tangent /= np.hypot(*tangent)
        return p + d * np.array([tangent[1], -tangent[0]]), tangent

    def thickness(self, s):
        return [np.interp(abs(s), profile[:, 0], profile[:, 1]) for profile in self.profiles]


def stations(wall, ends, size):
    """Returns the ends of the element columns, from -1 to 1. Ply ends are among them, and columns near ply ends are
    short."""
    half = sorted({0.0, 1.0, *ends})
    unit = 2 * size / wall.length
    s = [0.0]
    for a, b in zip(half, half[1:]):
        count = max(2, round((b - a) / unit))
        s += list(a + (b - a) * np.arange(1, count + 1) / count)
    return [-x for x in s[:0:-1]] + s


def isotropic(E, nu):
    G = E / (2 * (1 + nu))
    lame = E * nu / ((1 + nu) * (1 - 2 * nu))
    D = np.zeros((6, 6))
    D[:3, :3] = lame
    D += np.diag([2 * G] * 3 + [G] * 3)
    return D


def along(direction):
    """Returns the components of d (x) d in CalculiX' order 11, 22, 33, 12, 13, 23."""
    return np.array([direction[i] * direction[j]
                     for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))])


def deck(tire, angle, ply_thickness, size):
    wall = Wall(tire["section"])
    rubber = tire["rubber"]["matrix"]
    E, nu = number(rubber["young_modulus"]), rubber["poisson_ratio"]
    plies = [(name, math.copysign(angle, number(p["angle"])) if name != "carcass" else 90.0,
              number(p["offset"]), p.get("to", 1.0),
              number(p["young_modulus"]) * number(p["cord_area"]) / number(p["spacing"]))
             for name, p in tire["layer"].items()]
    half = ply_thickness / 2
    # None stands for the inner and the outer face of the wall; every gap between levels is one row of elements.
    inner = plies[0][2] - half
    outer = plies[-1][2] + half
    levels = [("in", 0), ("in", 1 / 3), ("in", 2 / 3)]
    for i, ply in enumerate(plies):
        levels += [ply[2] - half, ply[2] + half]
        if i + 1 < len(plies) and plies[i + 1][2] - ply[2] > 1.3:
            levels.append(0.5 * (ply[2] + plies[i + 1][2]))
    levels += [("out", 1 / 3), ("out", 2 / 3), ("out", 1)]

    def offset(s, level):
        inside, outside = wall.thickness(s)
        if isinstance(level, tuple):
            if level[0] == "in":
                return -inside + level[1] * (inner + inside)
            return outer + level[1] * (outside - outer)
        return level

    s = stations(wall, [p[3] for p in plies], size)
    columns, rows = len(s) - 1, len(levels) - 1
    text = ["*NODE,NSET=NALL"]
    node = {}
    angle_of = [0.0, math.pi / SECTORS, 2 * math.pi / SECTORS]
    # Nodes lie on a grid of half elements: (around 0..2, along, through), without the grid points at which quadratic
    # elements have no node.
    for a in range(3):
        for i in range(2 * columns + 1):
            for k in range(2 * rows + 1):
                if (a % 2) + (i % 2) + (k % 2) > 1:
                    continue
                si = 0.5 * (s[i // 2] + s[(i + 1) // 2])
                d = 0.5 * (offset(si, levels[k // 2]) + offset(si, levels[(k + 1) // 2]))
                (y, r), _ = wall.at(si, d)
                node[a, i, k] = len(node) + 1
                x, z = r * math.sin(angle_of[a]), -r * math.cos(angle_of[a])
                text.append(f"{node[a, i, k]},{x:.10g},{y:.10g},{z:.10g}")
    elements = {}
    text.append("*ELEMENT,TYPE=C3D20R,ELSET=ALL")
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4),
             (0, 4), (1, 5), (2, 6), (3, 7)]
    order = corners + [tuple((corners[p][q] + corners[r][q]) // 2 for q in range(3))
                       for p, r in edges]
    for i in range(columns):
        for k in range(rows):
            elements[i, k] = len(elements) + 1
            numbers = [node[a, 2 * i + b, 2 * k + c] for a, b, c in order]
            text.append(",".join(map(str, [elements[i, k]] + numbers[:10])) + ",")
            text.append(",".join(map(str, numbers[10:])))
    text += ["*ORIENTATION,NAME=CYLINDER,SYSTEM=CYLINDRICAL", "0,0,0,0,1,0"]
    # The elements of plain rubber come first, then those of every ply, column by column.
    ply_rows = {levels.index(p[2] - half): p for p in plies}
    plain = [elements[i, k] for i in range(columns) for k in range(rows)
             if k not in ply_rows or abs(0.5 * (s[i] + s[i + 1])) > ply_rows[k][3]]
    text.append("*ELSET,ELSET=PLAIN")
    text += [",".join(map(str, plain[j:j + 12])) + "," for j in range(0, len(plain), 12)]
    G, K = E / (2 * (1 + nu)), E / (3 * (1 - 2 * nu))
    density = number(rubber["density"])
    text += ["*MATERIAL,NAME=RUBBER", "*HYPERELASTIC,NEO HOOKE", f"{G / 2:.12g},{2 / K:.12g}",
             "*DENSITY", f"{density:.12g}", "*SOLID SECTION,ELSET=PLAIN,MATERIAL=RUBBER"]
    for k, (name, alpha, d, to, stiffness) in ply_rows.items():
        for i in range(columns):
            middle = 0.5 * (s[i] + s[i + 1])
            if abs(middle) > to:
                continue
            _, tangent = wall.at(middle, d)  # (y, r) components, toward the bead at -y
            # CalculiX' cylinder axes about +y: radial, circumferential, axial. The sense of the circumferential axis
            # does not matter, because the mirrored tire has the same growth and frequencies.
            around = np.array([0, 1, 0])
            along_wall = np.array([tangent[1], 0, tangent[0]])
            v = along(math.cos(math.radians(alpha)) * around +
                      math.sin(math.radians(alpha)) * along_wall)
            D = isotropic(E, nu) + stiffness / ply_thickness * np.outer(v, v)
            entries = [D[p, q] for q in range(6) for p in range(q + 1)]
            tag = f"{name.upper()}_{i}"
            text += [f"*ELSET,ELSET={tag}", str(elements[i, k]), f"*MATERIAL,NAME={tag}",
                     "*ELASTIC,TYPE=ANISO"]
            text += [",".join(f"{x:.10g}" for x in entries[j:j + 8]) for j in range(0, 21, 8)]
            text += ["*DENSITY", f"{density:.12g}",
                     f"*SOLID SECTION,ELSET={tag},MATERIAL={tag},ORIENTATION=CYLINDER"]
    for name, face in (("LEFT", 0), ("RIGHT", 1)):
        # Face 6 of an element lies in the first plane of the sector, face 4 in the second.
        text.append(f"*SURFACE,NAME={name},TYPE=ELEMENT")
        text += [f"{e},S{(6, 4)[face]}" for e in elements.values()]
    # Nodes of the first plane depend on those of the second, so only the latter are fixed.
    rim = [n for (a, i, k), n in node.items() if i in (0, 2 * columns) and a > 0]
    text.append("*NSET,NSET=RIM")
    text += [",".join(map(str, rim[j:j + 12])) + "," for j in range(0, len(rim), 12)]
    text.append("*ELSET,ELSET=INNER")
    text += [f"{elements[i, 0]}," for i in range(columns)]
    crown = node[0, columns, 2 * rows]
    text += ["*NSET,NSET=CROWN", str(crown),
             "*TIE,NAME=SECTOR,CYCLIC SYMMETRY", "LEFT,RIGHT",
             f"*CYCLIC SYMMETRY MODEL,N={SECTORS},NGRAPH=1,TIE=SECTOR", "0,0,0,0,1,0",
             "*BOUNDARY", "RIM,1,3"]
    p = number(tire["pressure"])
    text += ["*STEP,NLGEOM,INC=100", "*STATIC", "0.25,1.0", "*DLOAD", f"INNER,P1,{p:.10g}",
             "*NODE PRINT,NSET=CROWN,FREQUENCY=100", "U", "*END STEP"]
    # In a perturbation step CalculiX counts the load stiffness of a pressure twice, so the pressure is halved.
    text += ["*STEP,PERTURBATION", "*FREQUENCY,STORAGE=YES", f"{MODES},", "*DLOAD,OP=NEW",
             f"INNER,P1,{p / 2:.10g}",
             f"*SELECT CYCLIC SYMMETRY MODES,NMIN=0,NMAX={HARMONICS}", "*END STEP"]
    return "\n".join(text) + "\n"


def figures(tire, angle, ply_thickness, size):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "sector.inp").write_text(deck(tire, angle, ply_thickness, size))
        run = subprocess.run(["ccx", "-i", "sector"], cwd=folder, capture_output=True, text=True,
                             env={**os.environ, "OMP_NUM_THREADS": "1"})
        try:
            result = (Path(folder) / "sector.dat").read_text()
        except FileNotFoundError:
            sys.exit(run.stdout[-3000:])
    rows = []
    last = [line.split() for line in result.split("E I G E N")[0].splitlines()
            if re.match(r"\s+\d+(\s+[-+0-9.E]+){3}\s*$", line)][-1]
    rows.append(("growth [mm]", -float(last[3])))
    for line in result.splitlines():
        m = re.match(r"\s+(\d+)\s+(\d+)\s+(\S+)\s+(\S+)\s+(\S+)\s+(\S+)\s*$", line)
        if m and "E" in m[5]:
            rows.append((f"n={m[1]} mode {m[2]} [Hz]", float(m[5])))
    return rows


def main():
    tire = tomllib.loads((HERE / "tire.toml").read_text())
    if sys.argv[1:2] == ["--deck"]:
        sys.stdout.write(deck(tire, *map(float, sys.argv[2:5])))
        return
    print("angle [deg],ply [mm],column [mm],quantity,value")
    for angle in (22.0, 0.0):
        for ply, size in ((0.4, 4.0), (0.2, 4.0)):
            for name, value in figures(tire, angle, ply, size):
                print(f"{angle:g},{ply:g},{size:g},{name},{value:.6g}", flush=True)


if __name__ == "__main__":
    main()
