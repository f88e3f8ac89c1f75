#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the case files that Simbody and Latsch both read: fsae_corner.json, five_links.json and car_21_bodies.json.

   python3 make_cases.py        in this folder

Hardpoints are those of the parametric model of a student race car, set "fsae_parametrica", front and rear left; x
forward with the front axle at 1550 mm, y left, z up from the ground. The right side is the mirror image. Masses,
dampings and tires have the size that is usual for such a car. A wishbone is two thin tubes from its ball joint, a rod
is one."""
import json
import pathlib
import random

HERE = pathlib.Path(__file__).resolve().parent

FRONT = {  # mm
    "uca_chassis_front": (1648.347, 273.206, 303.434),
    "uca_chassis_rear": (1406.764, 273.327, 309.890),
    "lca_chassis_front": (1698.576, 262.926, 126.153),
    "lca_chassis_rear": (1442.210, 263.181, 150.828),
    "ubj": (1510.800, 527.786, 350.000),
    "lbj": (1539.399, 563.477, 148.512),
    "wheel_center": (1550.000, 612.500, 235.000),
    "pushrod_outer_on_uca": (1507.720, 499.027, 366.606),
    "pushrod_inner_on_rocker": (1507.720, 191.715, 544.030),
    "trackrod_outer": (1490.000, 553.400, 118.540),
    "trackrod_inner_rack": (1490.000, 266.310, 119.872),
}
REAR = {  # mm; the toe-link corresponds to the track-rod of the front axle
    "uca_chassis_front": (125.161, 318.339, 314.902),
    "uca_chassis_rear": (-160.644, 318.236, 310.835),
    "lca_chassis_front": (88.707, 307.596, 143.145),
    "lca_chassis_rear": (-169.595, 307.096, 119.973),
    "ubj": (-25.600, 530.800, 350.000),
    "lbj": (-6.400, 569.500, 130.400),
    "wheel_center": (0.000, 612.500, 235.000),
    "pushrod_outer_on_uca": (-30.415, 504.540, 362.808),
    "pushrod_inner_on_rocker": (-67.290, 303.410, 460.910),
    "trackrod_outer": (65.785, 570.499, 136.865),
    "trackrod_inner_rack": (84.331, 356.843, 141.969),
}
FIVE_LINKS = {  # mm, inner and outer joint; the corner of studies/suspensions/five_link_rear.toml
    "upper_front": ((60, 420, 480), (20, 690, 500)),
    "upper_rear": ((-110, 400, 470), (-40, 690, 490)),
    "lower_front": ((330, 470, 260), (60, 700, 210)),
    "lower_rear": ((-60, 200, 220), (-30, 720, 190)),
    "toe_link": ((-200, 300, 255), (-150, 715, 235)),
    "pushrod": ((-30, 560, 620), (-10, 660, 260)),
}
RUBBER = {"upper_front": 4e6, "upper_rear": 4e6, "lower_front": 2e6, "lower_rear": 6e6, "toe_link": 6e6}  # N/m, inner ends
RADIUS = 0.235  # m, radius of the unloaded tire
BUSHING = {
    "stiffness": [3e7] * 3,
    "rotational_stiffness": [200.0] * 3,
    "damping": [3e3] * 3,
    "rotational_damping": [0.2] * 3,
}
JOINTS = [  # name, body a, body b
    ("uca_chassis_front", "chassis", "upper_wishbone"),
    ("uca_chassis_rear", "chassis", "upper_wishbone"),
    ("lca_chassis_front", "chassis", "lower_wishbone"),
    ("lca_chassis_rear", "chassis", "lower_wishbone"),
    ("ubj", "upper_wishbone", "upright"),
    ("lbj", "lower_wishbone", "upright"),
    ("pushrod_inner_on_rocker", "chassis", "push_rod"),
    ("pushrod_outer_on_uca", "push_rod", "upper_wishbone"),
    ("trackrod_inner_rack", "chassis", "track_rod"),
    ("trackrod_outer", "track_rod", "upright"),
]
TUBE_RADIUS = 0.008  # m, radius of rods and of the tubes of wishbones


def meters(points, side):
    """Returns the points of the left side (side = 1), or mirrored to the right side (side = -1)."""
    return {name: [round(x / 1e3, 9), round(side * y / 1e3, 9), round(z / 1e3, 9)] for name, (x, y, z) in points.items()}


def tubes(name, mass, ends):
    """Returns a body of thin tubes of equal wall thickness and mass: its center of mass, and its inertia about that.
    """
    each = mass / len(ends)
    middles = [[(p + q) / 2 for p, q in zip(a, b)] for a, b in ends]
    center = [sum(middle[i] for middle in middles) / len(ends) for i in range(3)]
    tensor = [[0.0] * 3 for _ in range(3)]
    for (a, b), middle in zip(ends, middles):
        along = [q - p for p, q in zip(a, b)]
        length2 = sum(x * x for x in along)
        arm = [p - q for p, q in zip(middle, center)]
        # Inertia of a tube about its middle: m/12 (l^2 1 - l l') of a line, plus m r^2 about its axis and half of
        # that across; then the parallel-axis term m (d^2 1 - d d').
        for i in range(3):
            for j in range(3):
                unit = 1.0 if i == j else 0.0
                axis = along[i] * along[j] / length2
                tensor[i][j] += each * ((length2 * unit - along[i] * along[j]) / 12
                                        + TUBE_RADIUS**2 * (unit + axis) / 2
                                        + sum(x * x for x in arm) * unit - arm[i] * arm[j])
    return body(name, mass, center, [tensor[0][0], tensor[1][1], tensor[2][2],
                                     tensor[0][1], tensor[0][2], tensor[1][2]])


def body(name, mass, center, inertia):
    return {"name": name, "mass": mass, "center_of_mass": [round(x, 9) for x in center],
            "inertia": [float(f"{x:.6e}") for x in inertia]}


def corner(points, of=""):
    """Returns a corner of five bodies and ten bushings; the suffix `of` is appended to their names."""
    bodies = [
        tubes("upper_wishbone" + of, 0.8, [(points["ubj"], points["uca_chassis_front"]),
                                           (points["ubj"], points["uca_chassis_rear"])]),
        tubes("lower_wishbone" + of, 1.0, [(points["lbj"], points["lca_chassis_front"]),
                                           (points["lbj"], points["lca_chassis_rear"])]),
        body("upright" + of, 12.0, points["wheel_center"], [0.25, 0.42, 0.25, 0.0, 0.0, 0.0]),
        tubes("push_rod" + of, 0.4, [(points["pushrod_inner_on_rocker"], points["pushrod_outer_on_uca"])]),
        tubes("track_rod" + of, 0.3, [(points["trackrod_inner_rack"], points["trackrod_outer"])]),
    ]
    bushings = [{"name": name + of, "a": a if a == "chassis" else a + of, "b": b + of,
                 "point": points[name], **BUSHING} for name, a, b in JOINTS]
    return bodies, bushings


def random_loads(count):
    """Returns loads with the magnitudes of the other load cases and with random directions."""
    draw = random.Random(20)
    each = lambda reach: [float(f"{draw.uniform(-reach, reach):.6g}") for _ in range(3)]
    return [(f"random {i}", each(4e3), each(150.0)) for i in range(1, count + 1)]


FIVE_LOADS = [  # N and N m, at the contact point
    ("Fz +5 kN", [0.0, 0.0, 5e3], [0.0, 0.0, 0.0]),
    ("Fy -4 kN", [0.0, -4e3, 0.0], [0.0, 0.0, 0.0]),
    ("Fx -4 kN", [-4e3, 0.0, 0.0], [0.0, 0.0, 0.0]),
    ("Mz +200 Nm", [0.0, 0.0, 0.0], [0.0, 0.0, 200.0]),
    ("combined", [-2500.0, 3000.0, 4500.0], [0.0, 0.0, 120.0]),
]


def fsae_corner():
    points = meters(FRONT, 1)
    bodies, bushings = corner(points)
    for bushing in bushings:
        bushing["a"] = "ground" if bushing["a"] == "chassis" else bushing["a"]
    contact = [points["wheel_center"][0], points["wheel_center"][1], 0.0]

    def case(name, force, moment):
        return {"name": name, "loads": [{"body": "upright", "point": contact, "force": force, "moment": moment}]}

    return {
        "about": "Front left corner of a student race car, its chassis held; SI, x forward, y left, z up.",
        "gravity": [0.0, 0.0, 0.0],
        "bodies": bodies,
        "bushings": bushings,
        "loads": [],
        "load_cases": [case(*one) for one in FIVE_LOADS + random_loads(20)],
        "outputs": [{"name": name, "body": "upright", "point": point} for name, point in (
            ("contact", contact), ("wheel_center", points["wheel_center"]), ("ubj", points["ubj"]),
            ("lbj", points["lbj"]))],
    }


def five_links():
    points = {name: meters({"inner": inner, "outer": outer}, 1) for name, (inner, outer) in FIVE_LINKS.items()}
    bodies = [body("upright", 20.0, [0.0, 0.78, 0.32], [0.5, 0.8, 0.5, 0.0, 0.0, 0.0])]
    bushings = []
    for name, ends in points.items():
        bodies.append(tubes(name, 1.0, [(ends["inner"], ends["outer"])]))
        for end, a, b in (("inner", "ground", name), ("outer", name, "upright")):
            rubber = end == "inner" and name in RUBBER
            bushings.append({"name": name + "_" + end, "a": a, "b": b, "point": ends[end],
                             "stiffness": [RUBBER[name] if rubber else 2e7] * 3,
                             "rotational_stiffness": [50.0 if rubber else 20.0] * 3,
                             "damping": [3e3] * 3, "rotational_damping": [0.2] * 3})
    contact = [0.0, 0.78, 0.0]
    return {
        "about": "Rear left corner on five links, its chassis and the end of its strut held; SI, x forward, y left, z up.",
        "gravity": [0.0, 0.0, 0.0],
        "bodies": bodies,
        "bushings": bushings,
        "loads": [],
        "load_cases": [{"name": name, "loads": [{"body": "upright", "point": contact, "force": force, "moment": moment}]}
                       for name, force, moment in FIVE_LOADS + random_loads(10)],
        "outputs": [{"name": name, "body": "upright", "point": point}
                    for name, point in (("contact", contact), ("wheel_center", [0.0, 0.78, 0.32]))],
    }


def car():
    corners = {"_" + axle + side: meters(points, sign)
               for axle, points in (("f", FRONT), ("r", REAR)) for side, sign in (("l", 1), ("r", -1))}
    bodies = [body("chassis", 180.0, [0.75, 0.0, 0.30], [18.0, 90.0, 95.0, 0.0, -2.5, 0.0])]
    bushings, tires = [], []
    for of, points in corners.items():
        more_bodies, more_bushings = corner(points, of)
        bodies += more_bodies
        bushings += more_bushings
        tires.append({"name": "tire" + of, "body": "upright" + of, "wheel_center": points["wheel_center"],
                      "radius": RADIUS, "stiffness": 117e3, "damping": 300.0})
    fl, rl = corners["_fl"], corners["_rl"]
    outputs = [("chassis", "chassis", [0.75, 0.0, 0.30]), ("chassis_nose", "chassis", [2.1, 0.0, 0.25])]
    outputs += [("wheel_center" + of, "upright" + of, points["wheel_center"]) for of, points in corners.items()]
    outputs += [("contact_fl", "upright_fl", [fl["wheel_center"][0], fl["wheel_center"][1], 0.0]),
                ("pushrod_outer_fl", "push_rod_fl", fl["pushrod_outer_on_uca"]),
                ("pushrod_outer_rl", "push_rod_rl", rl["pushrod_outer_on_uca"])]
    return {
        "about": "A car of 21 bodies on 40 bushings and four linear tires, its left wheels over a kerb; "
                 "SI, x forward, y left, z up.",
        "gravity": [0.0, 0.0, -9.81],
        "bodies": bodies,
        "bushings": bushings,
        "loads": [
            {"name": "downforce_front", "body": "chassis", "point": [1.8, 0.0, 0.15],
             "force": [0.0, 0.0, -4e3], "moment": [0.0, 0.0, 0.0]},
            {"name": "downforce_rear", "body": "chassis", "point": [-0.2, 0.0, 0.6],
             "force": [0.0, 0.0, -5e3], "moment": [0.0, 0.0, 0.0]},
        ],
        "tires": tires,
        "held_in_statics": {"body": "chassis", "stiffness": [1e6, 1e6, 0.0], "rotational_stiffness": [0.0, 0.0, 1e6]},
        "road": {"pitch": 0.8, "height": 0.025, "start": 3.0, "count": 15, "lateral": [0.2, 1.0]},
        "speed": 60.0,
        "time": 0.3,
        "output_step": 1e-3,
        "outputs": [{"name": name, "body": of, "point": point} for name, of, point in outputs],
    }


def text(case):
    """Formats a case as JSON with one line for each body, bushing, load or point."""
    rows = []
    for key, value in case.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            value = "[\n    " + ",\n    ".join(json.dumps(one) for one in value) + "\n  ]"
        else:
            value = json.dumps(value)
        rows.append(f'  "{key}": {value}')
    return "{\n" + ",\n".join(rows) + "\n}\n"


if __name__ == "__main__":
    (HERE / "fsae_corner.json").write_text(text(fsae_corner()))
    (HERE / "five_links.json").write_text(text(five_links()))
    (HERE / "car_21_bodies.json").write_text(text(car()))
