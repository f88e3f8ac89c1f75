#!/usr/bin/env python3
"""Compares a car on four posts with an independent linear model in NumPy, from 0.5 to 20 Hz, with the default
settings of the test.

   four_post_test.py PATH/TO/latsch

The reference uses the car's file and Lagrange's equations, and shares no code or coordinates with the program. The
program moves 25 bodies on joints of 1e10 N/m; the reference has rigid links and the coordinates
   q:  x, y, z and the rotation of the chassis; at each corner the angle of the lower wishbone;
       at each corner the gap g between push-rod and rocker, along the push-rod, which a force N closes (g = 0).
Positions p(q) follow from the closure of the linkage. With rods whose ends move at v and w,
   T = Σ m (v² + v w + w²)/6 + Σ (m v² + ω I ω)/2          thin rods; chassis and uprights
   V = Σ m g z + Σ (F_0 e + k e²/2) + Σ k_b (e_b,left - e_b,right)²/2 + Σ k_t (R + h - z_w)²/2
about the equilibrium ∂V/∂q = 0, M = ∂²T/∂q'∂q', K = ∂²V/∂q∂q, C = Σ c ∂e/∂q ∂e/∂q', and the guide of docs/car.md (5),
(5a). Index q means the rows of the coordinates, index g those of the gaps:
   (K_qq + iω C_qq - ω² M_qq) q = (k_t + iω c_t) ∂z_w/∂q h,     N = (K_gq + iω C_gq - ω² M_gq) q"""
import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

try:
    import numpy as np
except ModuleNotFoundError:
    print("skipped: there is no NumPy (Debian: python3-numpy)")
    sys.exit(77)

LATSCH = sys.argv.pop(1) if len(sys.argv) > 1 else "latsch"
STUDIES = pathlib.Path(__file__).resolve().parents[2] / "studies"
CORNERS = ("FL", "FR", "RL", "RR")
SIGNS = {"heave": (1, 1, 1, 1), "pitch": (1, 1, -1, -1), "roll": (1, -1, 1, -1)}
GRAVITY = 9.80665  # m/s^2
UNITS = {"mm": 1e-3, "m": 1.0, "kg": 1.0, "kg m^2": 1.0, "N/mm": 1e3, "kN s/m": 1e3, "N s/m": 1.0}
GUIDE_ALONG, GUIDE_ACROSS, GUIDE_YAW = 20e3, 20e3, 50e3  # N/m, N/m, N m/rad


def si(words):
    if isinstance(words, list):
        return np.array([si(word) for word in words])
    number, unit = words.split(" ", 1)
    return float(number) * UNITS[unit]


def turned(axis, angle):
    """Returns the matrix of the rotation about a unit axis by an angle [Rodrigues]."""
    x, y, z = axis
    N = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * N + (1 - np.cos(angle)) * N @ N


def rotation(vector):
    angle = np.linalg.norm(vector)
    return np.eye(3) if angle == 0 else turned(vector / angle, angle)


def unit(vector):
    return vector / np.linalg.norm(vector)


class Corner:
    """The linkage of one corner, in the axes of the chassis at the drawn position."""

    def __init__(self, axle, points, left):
        self.p = {name: si(at) * (1.0 if left else np.array([1.0, -1.0, 1.0])) for name, at in points.items()}
        mass = {part: si(words) for part, words in axle["mass"].items()}
        self.mass, self.spring = mass, axle["spring"]
        self.k, self.c = si(axle["spring"]["stiffness"]), si(axle["spring"]["damping"])
        self.bar = si(axle["anti_roll_bar"]["stiffness"]) if "anti_roll_bar" in axle else 0.0
        tire = axle["spring_tire"]
        self.R, self.kt, self.ct = si(tire["radius"]), si(tire["stiffness"]), si(tire["damping"])
        across = si(axle["inertia"]["wheel_across"])  # about y, the axis about which the wheel turns freely
        self.I = np.diag(si(axle["inertia"]["upright"]) + np.array([across, 0.0, across]))
        self.known = {}

    def about(self, name, front, rear, angle):
        """Returns a point of a wishbone that has turned about the line between its inner joints."""
        p = self.p
        return p[front] + turned(unit(p[rear] - p[front]), angle) @ (p[name] - p[front])

    def at(self, s, gap):
        """Returns the rods as (mass, end, end), the wheel center, the rotation of the upright, and the lengths of the
        spring and of the anti-roll bar's link."""
        if (s, gap) not in self.known:
            self.known[s, gap] = self.closed(s, gap)
        return self.known[s, gap]

    def closed(self, s, gap):
        p, m = self.p, self.mass
        lbj = self.about("lbj", "lca_front", "lca_rear", s)

        def upright(u):  # u: angle of the upper wishbone and rotation vector of the upright about lbj
            ubj, R = self.about("ubj", "uca_front", "uca_rear", u[0]), rotation(u[1:])
            track = lbj + R @ (p["trackrod_outer"] - p["lbj"])
            length = np.linalg.norm(p["trackrod_outer"] - p["trackrod_inner"])
            return np.append(lbj + R @ (p["ubj"] - p["lbj"]) - ubj, np.linalg.norm(track - p["trackrod_inner"]) - length)

        u = newton(upright, np.zeros(4))
        ubj, R = self.about("ubj", "uca_front", "uca_rear", u[0]), rotation(u[1:])
        outer = self.about("pushrod_outer", "uca_front", "uca_rear", u[0])
        length = np.linalg.norm(p["pushrod_outer"] - p["pushrod_inner"])
        pivot = p["rocker_pivot"]
        axis = unit(np.cross(p["pushrod_inner"] - pivot, p["rocker_damper"] - pivot))

        def rocker(a):
            inner = pivot + turned(axis, a[0]) @ (p["pushrod_inner"] - pivot)
            return np.array([np.linalg.norm(inner - outer) - length - gap])

        turn = turned(axis, newton(rocker, np.zeros(1))[0])
        inner, damper = pivot + turn @ (p["pushrod_inner"] - pivot), pivot + turn @ (p["rocker_damper"] - pivot)
        rods = []
        for mass, *ends in ((m["upper_wishbone"], (p["uca_front"], ubj), (p["uca_rear"], ubj)),
                            (m["lower_wishbone"], (p["lca_front"], lbj), (p["lca_rear"], lbj)),
                            (m["trackrod"], (p["trackrod_inner"], lbj + R @ (p["trackrod_outer"] - p["lbj"]))),
                            (m["pushrod"], (outer + length * unit(inner - outer), outer)),
                            (m["rocker"], (pivot, inner), (pivot, damper))):
            whole = sum(np.linalg.norm(b - a) for a, b in ends)
            rods += [(mass * np.linalg.norm(b - a) / whole, a, b) for a, b in ends]
        wheel = lbj + R @ (p["wheel_center"] - p["lbj"])
        link = 0.0
        if self.bar:
            link = np.linalg.norm(pivot + turn @ (p["rocker_arb_link"] - pivot) - p["arb_link_blade"])
        return rods, wheel, R, np.array([np.linalg.norm(damper - p["damper_chassis"]), link])


def newton(f, u):
    for _ in range(30):
        residual = f(u)
        if np.abs(residual).max() < 1e-15:
            return u
        h = 1e-7
        J = np.column_stack([(f(u + h * e) - f(u - h * e)) / (2 * h) for e in np.eye(len(u))])
        step = np.linalg.solve(J, residual)
        u = u - step
        if np.abs(step).max() < 1e-14:
            return u
    raise AssertionError("the linkage does not close")


class LinearCar:
    """M, C and K for q and the gaps, about the car at rest; coordinates 0 to 5 belong to the chassis, 6 to 9 to the
    corners, 10 to 13 are the gaps."""

    def __init__(self, file):
        car = tomllib.loads(file.read_text())
        axles = [(car[name], tomllib.loads((file.parent / car[f"{name}_suspension"]).read_text())["hardpoint"])
                 for name in ("front", "rear")]
        self.corners = [Corner(*axles[i // 2], i % 2 == 0) for i in range(4)]
        chassis = car["chassis"]
        self.m, self.center = si(chassis["mass"]), si(chassis["center"])
        self.I = np.diag([si(chassis[f"inertia_{two}"]) for two in ("xx", "yy", "zz")])
        self.rest = np.zeros(14)
        self.L0 = np.array([corner.at(0.0, 0.0)[3] for corner in self.corners])
        self.F0 = np.zeros(4)
        self.stand()
        self.differentiate()

    def parts(self, q):
        place, R = self.center + q[:3], rotation(q[3:6])
        for corner, s, gap in zip(self.corners, q[6:10], q[10:14]):
            rods, wheel, turn, length = corner.at(s, gap)

            def world(p):
                return place + R @ (p - self.center)

            yield [(m, world(a), world(b)) for m, a, b in rods], world(wheel), R @ turn, length

    def potential(self, q):
        V = self.m * GRAVITY * q[2]
        extensions = np.zeros((4, 2))
        for i, (corner, (rods, wheel, _, length)) in enumerate(zip(self.corners, self.parts(q))):
            V += GRAVITY * sum(0.5 * m * (a[2] + b[2]) for m, a, b in rods)
            V += GRAVITY * (corner.mass["upright"] + corner.mass["wheel"]) * wheel[2]
            V += 0.5 * corner.kt * (corner.R - wheel[2]) ** 2
            e, _ = extensions[i] = length - self.L0[i]
            V += self.F0[i] * e + 0.5 * corner.k * e**2
        links = extensions[:, 1]
        return V + sum(0.5 * self.corners[i].bar * (links[i] - links[i + 1]) ** 2 for i in (0, 2))

    def slope(self, f, i, h=1e-5):
        e = h * np.eye(14)[i]
        return (f(self.rest + e) - f(self.rest - e)) / (2 * h)

    def stand(self):
        """Lowers the car in its drawn position until the tires carry it, and sets the forces of the springs so that
        they carry the weight above them."""
        for _ in range(5):
            f = np.array([self.slope(self.potential, i) for i in (2, 4)])
            K = np.array([[self.bend(i, j) for j in (2, 4)] for i in (2, 4)])
            self.rest[[2, 4]] -= np.linalg.solve(K, f)
        by_travel = [self.slope(lambda q: self.lengths(q)[i], 6 + i) for i in range(4)]
        self.F0 = np.array([-self.slope(self.potential, 6 + i) / by_travel[i] for i in range(4)])

    def bend(self, i, j, h=1e-4):
        a, b = h * np.eye(14)[i], h * np.eye(14)[j]
        V = self.potential
        return (V(self.rest + a + b) - V(self.rest + a - b) - V(self.rest - a + b) + V(self.rest - a - b)) / (4 * h * h)

    def lengths(self, q):
        return np.array([part[3][0] for part in self.parts(q)])

    def differentiate(self):
        rest = list(self.parts(self.rest))
        ends = np.array([[self.slope(lambda q: self.flat(q)[0], j)] for j in range(14)])[:, 0]
        masses = np.concatenate([[m for m, _, _ in part[0]] for part in rest])
        self.M = np.zeros((14, 14))
        v, w = ends[:, :, 0], ends[:, :, 1]  # indices: coordinate, rod, axis
        for x, y, share in ((v, v, 1 / 3), (w, w, 1 / 3), (v, w, 1 / 6), (w, v, 1 / 6)):
            self.M += share * np.einsum("r,ira,jra->ij", masses, x, y)
        # indices: coordinate, corner, axis
        self.wheels = np.array([self.slope(lambda q: self.flat(q)[1], j) for j in range(14)])
        for i, (corner, part) in enumerate(zip(self.corners, rest)):
            J = self.wheels[:, i]
            self.M += (corner.mass["upright"] + corner.mass["wheel"]) * J @ J.T
            R = part[2]
            spin = np.array([self.spin(lambda q: list(self.parts(q))[i][2], R, j) for j in range(14)])
            self.M += spin @ R @ corner.I @ R.T @ spin.T
        self.M[:3, :3] += self.m * np.eye(3)
        R = rotation(self.rest[3:6])
        self.M[3:6, 3:6] += R @ self.I @ R.T
        self.K = np.zeros((14, 14))
        for i in range(14):
            for j in range(i + 1):
                self.K[i, j] = self.K[j, i] = self.bend(i, j)
        springs = np.array([self.slope(self.lengths, j) for j in range(14)])  # coordinate, corner
        self.C = springs @ np.diag([corner.c for corner in self.corners]) @ springs.T
        up = self.wheels[:, :, 2]
        self.C += up @ np.diag([corner.ct for corner in self.corners]) @ up.T
        self.up, self.heights = up, np.array([part[1][2] for part in rest])
        self.add_guide(sum(masses) + self.m + sum(c.mass["upright"] + c.mass["wheel"] for c in self.corners))

    def add_guide(self, mass):
        """Adds the guide: it acts on the chassis along y and about z; along x it acts at the rear wheels, with the
        moment of the drive shafts."""
        works = 0.5 * (self.wheels[:, 2, 0] + self.wheels[:, 3, 0])
        works[4] -= 0.5 * (self.heights[2] + self.heights[3])
        for at, k, inertia, row in ((0, GUIDE_ALONG, mass, works), (1, GUIDE_ACROSS, mass, np.eye(14)[1]),
                                    (5, GUIDE_YAW, self.I[2, 2], np.eye(14)[5])):
            self.K[:, at] += k * row
            self.C[:, at] += 2 * np.sqrt(k * inertia) * row

    def flat(self, q):
        parts = list(self.parts(q))
        return np.array([[a, b] for part in parts for _, a, b in part[0]]), np.array([part[1] for part in parts])

    def spin(self, turn, R, j, h=1e-5):
        e = h * np.eye(14)[j]
        S = (turn(self.rest + e) - turn(self.rest - e)) / (2 * h) @ R.T
        return np.array([S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]]) / 2

    def response(self, frequency, signs):
        """Returns the transfer functions of all sensors, N/m and 1/s^2, for posts that move with the given signs."""
        w = 2 * np.pi * frequency
        D = self.K + 1j * w * self.C - w**2 * self.M
        tire = np.array([corner.kt + 1j * w * corner.ct for corner in self.corners])
        q = np.linalg.solve(D[:10, :10], self.up[:10] @ (tire * np.array(signs)))
        forces = D[10:, :10] @ q
        found = {f"pushrod_{name}": force for name, force in zip(CORNERS, forces)}
        found |= {f"hub_{name}": -(w**2) * z for name, z in zip(CORNERS, self.up[:10].T @ q)}
        return found | {"body_z": -(w**2) * q[2]}


# share of a response; time steps of 0.2 ms and joints of 1e10 N/m cause 0.0004 of it, the guide's longitudinal force
# in pitch 0.002
MOST = 0.005


class AgainstNumPy(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="latsch_four_post_")
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for name in ("kerb", "four_post"):
            shutil.copytree(STUDIES / name, self.folder / name, ignore=shutil.ignore_patterns("*.latsch", "*.html", "*.csv"))
        self.car = self.folder / "four_post" / "baseline.toml"

    def recorded(self, mode):
        """Returns the lines, Hz, and the complex transfer functions by sensor, from the test with default settings."""
        out = self.folder / "out.csv"
        done = subprocess.run([LATSCH, "test", self.car, f'{{kind = "four_post", spectra = true, mode = "{mode}"}}', "-o", out],
                              capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(out) as file:
            head, *rows = csv.reader(file)
        columns = {name.split(" [")[0]: np.array([float(row[i]) for row in rows if row[i]]) for i, name in enumerate(head)}
        return columns["frequency"], {name[3:]: column * np.exp(1j * columns["phase_" + name[3:]])
                                      for name, column in columns.items() if name.startswith("tf_")}

    def compare(self, mode, but=()):
        """Compares every sensor at every line from 0.5 to 20 Hz, in magnitude and phase."""
        lines, found = self.recorded(mode)
        linear = LinearCar(self.car)
        self.assertEqual(set(found), {f"{what}_{name}" for what in ("pushrod", "hub") for name in CORNERS} | {"body_z"})
        inside = (lines >= 0.5) & (lines <= 20.0)
        self.assertGreater(inside.sum(), 70)
        expected = [linear.response(line, SIGNS[mode]) for line in lines[inside]]
        for sensor in sorted(set(found) - set(but)):
            errors = [abs(value / of[sensor] - 1) for value, of in zip(found[sensor][inside], expected)]
            worst = int(np.argmax(errors))
            self.assertLess(errors[worst], MOST, f"{sensor} in {mode} at {lines[inside][worst]:.2f} Hz")

    def test_heave(self):
        self.compare("heave")

    def test_roll_on_an_anti_roll_bar(self):
        text = self.car.read_text()
        self.car.write_text(text.replace("[rear]\n", '[front.anti_roll_bar]\nstiffness = "40 N/mm"\n\n[rear]\n'))
        self.compare("roll", but=["body_z"])  # 0 by symmetry

    def test_pitch_of_another_car(self):
        edit = [(("front", "spring"), "stiffness", "65 N/mm"), (("rear", "spring"), "stiffness", "82 N/mm"),
                (("front", "spring"), "damping", "2 kN s/m"), (("rear", "spring"), "damping", "4 kN s/m"),
                (("front", "spring_tire"), "stiffness", "112 N/mm"), (("rear", "spring_tire"), "damping", "600 N s/m"),
                (("rear", "mass"), "upright", "6 kg"), (("chassis",), "inertia_yy", "105 kg m^2")]
        for table, key, value in edit:
            replace(self.car, ".".join(table), key, value)
        self.compare("pitch")

    def test_the_reference_depends_on_masses_springs_dampers_and_tires(self):
        def at_its_worst(other):
            return max(abs(other.response(f, SIGNS["pitch"])[s] / before[f][s] - 1) for f in (2.0, 6.0, 15.0) for s in before[f])

        before = {f: LinearCar(self.car).response(f, SIGNS["pitch"]) for f in (2.0, 6.0, 15.0)}
        whole = self.car.read_text()
        for table, key, value in (("front.mass", "wheel", "9 kg"), ("rear.spring", "stiffness", "50 N/mm"), ("chassis", "inertia_yy", "90 kg m^2"),
                                  ("rear.spring", "damping", "3.3 kN s/m"), ("front.spring_tire", "stiffness", "150 N/mm"),
                                  ("rear.mass", "pushrod", "0.8 kg")):
            with self.subTest(f"{table}.{key}"):
                replace(self.car, table, key, value)
                self.assertGreater(at_its_worst(LinearCar(self.car)), 2 * MOST)
                self.car.write_text(whole)


def replace(file, table, key, value):
    """Replaces the value of a key in a table of the car's file; both must exist."""
    text = file.read_text()
    head, tail = text.split(f"[{table}]\n", 1)
    tail, count = re.subn(rf'(?m)^{key} = "[^"]*"', f'{key} = "{value}"', tail, count=1)
    assert count and f"[{table}]" not in tail
    file.write_text(f"{head}[{table}]\n{tail}")


if __name__ == "__main__":
    unittest.main()
