#!/usr/bin/env python3
"""Tests dialects of files of other programs: PAC2002 with pressure, names and versions of .tir files, all of OpenCRG,
finite-element decks with equations, size designations.

PAC2002 is evaluated here a second time, in plain Python, from its documented formulas [Adams/Tire, PAC2002; as read
in Project Chrono's ChPac02Tire, which names its pressure terms].

   dialects_test.py PATH/TO/latsch"""
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT, Coarse, edit

PAC2002 = {
    "LFZO": 0.9, "LCX": 1.02, "LMUX": 0.95, "LEX": 1.1, "LKX": 0.97, "LHX": 1.05, "LVX": 0.9, "LGAX": 1.1,
    "LCY": 0.98, "LMUY": 1.04, "LEY": 0.9, "LKY": 1.03, "LHY": 0.95, "LVY": 1.1, "LGAY": 1.05, "LTR": 0.96,
    "LRES": 1.02, "LXAL": 0.97, "LYKA": 1.01, "LVYKA": 0.9, "LS": 1.1, "LMX": 1.03, "LVMX": 0.9, "LMY": 1.07,
    "LIP": 0.93,
    "PCX1": 1.6, "PDX1": 1.1, "PDX2": -0.12, "PDX3": 3.0, "PEX1": 0.3, "PEX2": 0.2, "PEX3": -0.1, "PEX4": 0.02,
    "PKX1": 22.0, "PKX2": -1.0, "PKX3": 0.2, "PHX1": 1e-3, "PHX2": 5e-4, "PVX1": 0.01, "PVX2": 0.005,
    "PPX1": -0.4, "PPX2": 0.3, "PPX3": -0.1, "PPX4": 0.06,
    "RBX1": 12.0, "RBX2": -9.0, "RCX1": 1.05, "REX1": 0.2, "REX2": -0.1, "RHX1": 0.002,
    "PCY1": 1.35, "PDY1": 1.0, "PDY2": -0.15, "PDY3": 2.0, "PEY1": -0.9, "PEY2": -0.3, "PEY3": 0.1, "PEY4": -4.0,
    "PKY1": -22.0, "PKY2": 1.7, "PKY3": 0.4, "PHY1": 2e-3, "PHY2": 1e-3, "PHY3": 0.03,
    "PVY1": 0.02, "PVY2": -0.01, "PVY3": -0.2, "PVY4": -0.1, "PPY1": -0.5, "PPY2": -0.2, "PPY3": 0.08, "PPY4": -0.05,
    "RBY1": 9.0, "RBY2": 7.0, "RBY3": 0.02, "RCY1": 1.04, "REY1": 0.1, "REY2": -0.05, "RHY1": 0.01, "RHY2": 0.005,
    "RVY1": 0.05, "RVY2": 0.02, "RVY3": -0.4, "RVY4": 12.0, "RVY5": 1.9, "RVY6": 11.0,
    "QSX1": 0.01, "QSX2": 0.8, "QSX3": 0.04, "QPX1": 0.6,
    "QSY1": 0.01, "QSY2": 0.02, "QSY3": 1e-3, "QSY4": 2e-4, "QSY5": 0.3, "QSY6": -0.1, "QSY7": -0.15, "QSY8": -0.4,
    "QBZ1": 9.0, "QBZ2": -1.1, "QBZ3": -0.3, "QBZ4": 0.2, "QBZ5": -0.3, "QBZ9": 10.0, "QBZ10": 0.05, "QCZ1": 1.15,
    "QDZ1": 0.1, "QDZ2": -0.01, "QDZ3": -0.2, "QDZ4": 1.5, "QDZ6": -1e-3, "QDZ7": 5e-4, "QDZ8": -0.2, "QDZ9": -0.05,
    "QEZ1": -1.4, "QEZ2": 0.3, "QEZ3": -0.2, "QEZ4": 0.2, "QEZ5": -1.0, "QHZ1": 5e-3, "QHZ2": -2e-3, "QHZ3": 0.15,
    "QHZ4": 0.03, "QPZ1": 0.45, "QPZ2": -0.35, "SSZ1": 0.02, "SSZ2": 0.01, "SSZ3": 0.3, "SSZ4": -0.1}
R0, FNOMIN, LONGVL, IP_NOM = 0.33, 4500.0, 16.6, 240e3
HEAD = f"""[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radian'
MASS = 'kg'
TIME = 'second'
PRESSURE = 'pascal'
[MODEL]
PROPERTY_FILE_FORMAT = 'Pac2002'
USE_MODE = 4
VXLOW = 0.1
LONGVL = {LONGVL}
[TIRE_CONDITIONS]
IP = {IP_NOM}
IP_NOM = {IP_NOM}
[DIMENSION]
UNLOADED_RADIUS = {R0}
[VERTICAL]
FNOMIN = {FNOMIN}
VERTICAL_STIFFNESS = 210000
"""
HOMES = (("L", "SCALING"), ("P.X", "LONGITUDINAL"), ("PPX", "LONGITUDINAL"), ("R.X", "LONGITUDINAL"), ("QSX", "OVERTURNING"),
         ("QPX", "OVERTURNING"), ("P.Y", "LATERAL"), ("R.Y", "LATERAL"), ("QSY", "ROLLING"), ("", "ALIGNING"))


def home(key):
    for pattern, section in HOMES:
        if all(p in (".", k) for p, k in zip(pattern, key)):
            return section + "_COEFFICIENTS"


def tir_of(values):
    return HEAD + "".join(f"[{home(key)}]\n{key} = {value}\n" for key, value in values.items())


def sign(x):
    return (x > 0) - (x < 0)


def magic(function, B, C, D, E, x):
    return D * function(C * math.atan(B * x - E * (B * x - math.atan(B * x))))


def pac2002(p, Fz, kappa, alpha, gamma, V, pressure):
    """Returns Fx, Fy, Mx, My, Mz in the axes ISO-W."""
    Fz0 = p["LFZO"] * FNOMIN
    d, p0 = (Fz - Fz0) / Fz0, p["LIP"] * IP_NOM
    i = (pressure - p0) / p0
    g = lambda name: p.get(name, 0.0)

    gx = gamma * p["LGAX"]
    SHx = (g("PHX1") + g("PHX2") * d) * p["LHX"]
    SVx = Fz * (g("PVX1") + g("PVX2") * d) * p["LVX"] * p["LMUX"]
    kx = kappa + SHx
    mux = (g("PDX1") + g("PDX2") * d) * (1 + g("PPX3") * i + g("PPX4") * i**2) * (1 - g("PDX3") * gx**2) * p["LMUX"]
    Kx = Fz * (g("PKX1") + g("PKX2") * d) * math.exp(g("PKX3") * d) * (1 + g("PPX1") * i + g("PPX2") * i**2) * p["LKX"]
    Cx = g("PCX1") * p["LCX"]
    Ex = (g("PEX1") + g("PEX2") * d + g("PEX3") * d**2) * (1 - g("PEX4") * sign(kx)) * p["LEX"]
    Fx0 = magic(math.sin, Kx / (Cx * mux * Fz), Cx, mux * Fz, Ex, kx) + SVx
    Bxa = g("RBX1") * math.cos(math.atan(g("RBX2") * kappa)) * p["LXAL"]
    Exa = g("REX1") + g("REX2") * d
    Fx = Fx0 * (magic(math.cos, Bxa, g("RCX1"), 1, Exa, alpha + g("RHX1"))
                / magic(math.cos, Bxa, g("RCX1"), 1, Exa, g("RHX1")))

    gy = gamma * p["LGAY"]
    Ky = (g("PKY1") * Fz0 * (1 + g("PPY1") * i) * math.sin(2 * math.atan(Fz / (g("PKY2") * Fz0 * (1 + g("PPY2") * i))))
          * (1 - g("PKY3") * abs(gy)) * p["LKY"])
    SHy = (g("PHY1") + g("PHY2") * d) * p["LHY"] + g("PHY3") * gy
    SVy = Fz * ((g("PVY1") + g("PVY2") * d) * p["LVY"] + (g("PVY3") + g("PVY4") * d) * gy) * p["LMUY"]
    ay = alpha + SHy
    muy = (g("PDY1") + g("PDY2") * d) * (1 + g("PPY3") * i + g("PPY4") * i**2) * (1 - g("PDY3") * gy**2) * p["LMUY"]
    Cy = g("PCY1") * p["LCY"]
    By = Ky / (Cy * muy * Fz)
    Ey = (g("PEY1") + g("PEY2") * d) * (1 - (g("PEY3") + g("PEY4") * gy) * sign(ay)) * p["LEY"]
    Fy0 = magic(math.sin, By, Cy, muy * Fz, Ey, ay) + SVy
    SVyk = (muy * Fz * (g("RVY1") + g("RVY2") * d + g("RVY3") * gamma) * math.cos(math.atan(g("RVY4") * alpha))
            * math.sin(g("RVY5") * math.atan(g("RVY6") * kappa)) * p["LVYKA"])
    Byk = g("RBY1") * math.cos(math.atan(g("RBY2") * (alpha - g("RBY3")))) * p["LYKA"]
    SHyk, Eyk = g("RHY1") + g("RHY2") * d, g("REY1") + g("REY2") * d
    Gyk = (magic(math.cos, Byk, g("RCY1"), 1, Eyk, kappa + SHyk) / magic(math.cos, Byk, g("RCY1"), 1, Eyk, SHyk))
    Fy = Gyk * Fy0 + SVyk

    at = alpha + g("QHZ1") + g("QHZ2") * d + (g("QHZ3") + g("QHZ4") * d) * gamma
    ar = alpha + SHy + SVy / Ky
    drag = Kx / Ky * kappa
    equivalent = lambda a: math.atan(math.hypot(math.tan(a), drag)) * sign(a)
    Bt = ((g("QBZ1") + g("QBZ2") * d + g("QBZ3") * d**2) * (1 + g("QBZ4") * gamma + g("QBZ5") * abs(gamma))
          * p["LKY"] / p["LMUY"])
    Dt = (Fz * (g("QDZ1") + g("QDZ2") * d) * (1 - g("QPZ1") * i) * (1 + g("QDZ3") * gamma + g("QDZ4") * gamma**2)
          * R0 / FNOMIN * p["LTR"])
    Et = ((g("QEZ1") + g("QEZ2") * d + g("QEZ3") * d**2)
          * (1 + (g("QEZ4") + g("QEZ5") * gamma) * 2 / math.pi * math.atan(Bt * g("QCZ1") * at)))
    t = magic(math.cos, Bt, g("QCZ1"), Dt, Et, equivalent(at)) * math.cos(alpha)
    Br = g("QBZ9") * p["LKY"] / p["LMUY"] + g("QBZ10") * By * Cy
    Dr = (Fz * R0 * ((g("QDZ6") + g("QDZ7") * d) * p["LRES"]
                     + (g("QDZ8") + g("QDZ9") * d) * (1 + g("QPZ2") * i) * gamma) * p["LMUY"])
    Mzr = Dr * math.cos(math.atan(Br * equivalent(ar))) * math.cos(alpha)
    s = R0 * (g("SSZ1") + g("SSZ2") * Fy / FNOMIN + (g("SSZ3") + g("SSZ4") * d) * gamma) * p["LS"]
    Mz = -t * (Fy - SVyk) + Mzr + s * Fx
    Mx = R0 * Fz * (g("QSX1") * p["LVMX"] - g("QSX2") * gamma * (1 + g("QPX1") * i) + g("QSX3") * Fy / FNOMIN) * p["LMX"]
    v = abs(V / LONGVL)
    My = (-R0 * Fz * (g("QSY1") + g("QSY2") * Fx / FNOMIN + g("QSY3") * v + g("QSY4") * v**4
                      + (g("QSY5") + g("QSY6") * Fz / FNOMIN) * gamma**2)
          * (Fz / FNOMIN)**g("QSY7") * (pressure / p0)**g("QSY8") * p["LMY"])
    return Fx, Fy, Mx, My, Mz


class InFolder(unittest.TestCase):
    assert_says = Coarse.assert_says

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_dialects_"))

    def tearDown(self):
        shutil.rmtree(self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300,
                             cwd=self.folder)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def answers(self, tire, test):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", tire, test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}


class Pac2002(InFolder):
    def test_forces_and_moments_at_any_pressure_are_those_of_the_documented_formulas(self):
        self.write("tire.tir", tir_of(PAC2002))
        draw = random.Random(7)
        states = [(draw.uniform(500, 9000), draw.uniform(-0.9, 0.9), draw.uniform(-0.4, 0.4), draw.uniform(-0.12, 0.12),
                   draw.uniform(3, 50), draw.uniform(150e3, 350e3)) for _ in range(400)]
        self.write("states.csv", "Fz,kappa,alpha,gamma,Vx,p\n" + "".join(",".join(map(repr, s)) + "\n" for s in states))
        found = self.answers("tire.tir", '{kind = "steady_states", states = "states.csv", limits = "off"}')
        moved = 0.0
        for k, state in enumerate(states):
            expected = pac2002(PAC2002, *state)
            nominal = pac2002(PAC2002, *state[:5], IP_NOM * PAC2002["LIP"])
            moved = max(moved, abs(expected[4] - nominal[4]))
            for name, value in zip(("Fx", "Fy", "Mx", "My", "Mz"), expected, strict=True):
                self.assertAlmostEqual(found[name][k], value, delta=2e-5 + 1e-7 * abs(value), msg=f"{name} {state}")
        self.assertGreater(moved, 10.0)  # N m: the pressure has an effect

    def test_check_and_show_say_what_each_key_was_taken_for(self):
        self.write("tire.tir", tir_of(PAC2002) + "[VERTICAL]\nQFZ3 = 5\nQFZI = 3\n[MODEL]\nFE_METHOD = 'NO'\n")
        said = self.latsch("check", "tire.tir")
        self.assert_says(said, "no FITTYP; Pac2002 is evaluated with the equations of MF 5.2", "QFZ3 = 5 has no effect",
                         "[VERTICAL] QFZI is not known here", 'did you mean "QFZ1"')
        self.assertNotIn("FE_METHOD =", said)  # the key has the value 'NO', which requests nothing
        self.assert_says(self.latsch("show", "tire.tir"), "PPMX1", "multiplies NOMPRES", "friction ellipse")

    def test_a_file_with_warnings_is_not_called_in_order(self):
        self.write("meters_for_millimeters.tir", re.sub(r"(UNLOADED_RADIUS *= *)\S+", r"\g<1>330", tir_of(PAC2002)))
        said = self.latsch("check", "meters_for_millimeters.tir")
        self.assertIn("UNLOADED_RADIUS is 330 m", said)
        self.assertRegex(said, "Nothing is refused, but there (is|are) [0-9]+ warning")
        self.assertNotIn("Everything is in order", said)

    def test_names_and_versions(self):
        plain = {key: value for key, value in PAC2002.items() if key != "LIP"}
        text = tir_of(plain)
        for line in ("FITTYP = 52", "FITTYP = 21", "FITTYP = 5", "PROPERTY_FILE_FORMAT = 'MF-Tyre'", "property_file_format = 'mf_05'"):
            self.write("tire.tir", text.replace("PROPERTY_FILE_FORMAT = 'Pac2002'", line))
            self.assert_says(self.latsch("check", "tire.tir"), 'Magic Formula')
        for name in ("PAC89", "PAC94", "PAC-TIME", "FTire", "SWIFT", "521", "UA", "FIALA", "pac_mc"):
            self.write("tire.tir", text.replace("Pac2002", name))
            self.assert_says(self.latsch("check", "tire.tir", code=WRONG_INPUT), "tire.tir:9: ",
                             f'PROPERTY_FILE_FORMAT is "{name}"')
        self.write("tire.tir", text.replace("PROPERTY_FILE_FORMAT = 'Pac2002'", "FITTYP = 53"))
        self.assert_says(self.latsch("check", "tire.tir", code=WRONG_INPUT), "FITTYP is 53",
                         "5, 6, 21, 51 or 52 (MF 5.2), 60 or 61 (MF 6.1), 62 (MF 6.2)")


ROAD = """$CT
own file
$
$ROAD_CRG
REFERENCE_LINE_START_U = 0.0
REFERENCE_LINE_END_U = 4.0
REFERENCE_LINE_INCREMENT = 1.0
LONG_SECTION_V_RIGHT = -1.0
LONG_SECTION_V_LEFT = 1.0
LONG_SECTION_V_INCREMENT = 1.0
%s$
%s$KD_Definition
#:LRFI
D:reference line phi,rad
D:long section 1,m
D:long section 2,m
D:long section 3,m
$
$$$$
 0.0000000 0.0000000 0.0100000 0.0200000
 0.0000000 0.0100000 0.0200000 0.0300000
 0.0000000 0.0300000 0.0200000 0.0100000
 0.0000000 0.0000000 0.0400000 0.0000000
 0.0000000 0.0100000 0.0100000 0.0100000
"""


class OpenCrg(InFolder):
    def heights(self, road):
        rows = [line.split(",") for line in self.latsch("road", road, "points.csv").splitlines() if line[:1] in "0123456789-"]
        return [float(row[2]) for row in rows]

    def test_statements_of_the_standard_leave_the_surface_and_are_shown(self):
        self.write("points.csv", "x,y\n0,-1\n1,0\n2,1\n2.5,-0.5\n3,0\n4,1\n")
        right = [0, 0.02, 0.01, 0.0225, 0.04, 0.01]  # computed by hand from the friction in the file
        globe = "".join(f"REFERENCE_LINE_{end}_{axis} = {value}\n" for end in ("START", "END")
                        for axis, value in (("LON", 11.1234567), ("LAT", 48.1), ("ALT", 512.3)))
        for name, road, shown in (
                ("plain", ROAD % ("", ""), ()),
                ("globe", ROAD % (globe, ""), ("reference_line_start_lon = 11.1234567", "WGS 84")),
                ("map", ROAD % ("", "$ROAD_CRG_MPRO\nPROJ_NM = 'UTM_32U'\n$\n"), ("proj_nm = 'UTM_32U'",)),
                ("checks", ROAD % ("", "$ROAD_CRG_OPTS\nCHECK_PRO = 0.005\nCHECK_WGS = 10\n$\n"), ("check_wgs = 10",))):
            self.write(f"{name}.crg", road)
            for found, expected in zip(self.heights(f"{name}.crg"), right, strict=True):
                self.assertAlmostEqual(found, expected, delta=1e-9, msg=name)
            self.assert_says(self.latsch("show", f"{name}.crg"), *shown)
            self.assert_says(self.latsch("road", f"{name}.crg", "points.csv", "--output", "out.csv"), *shown)
        self.write("control.crg", "$CT\ncontrol\n$\n$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\n$\n")
        self.write("both.crg", "$CT\ntwo\n$\n$ROAD_CRG_FILE\ncontrol.crg\nplain.crg\n$\n")
        for found, expected in zip(self.heights("both.crg"), right, strict=True):
            self.assertAlmostEqual(found, 2 * expected, delta=1e-9)


class DeckWithEquations(Coarse):
    """Returns the deck of a tire whose rows of elements end in the sidewall: the deck ties their corner nodes by
    *EQUATION."""

    def test_a_deck_of_our_own_is_read_to_the_same_results(self):
        tire, deck = self.folder / "tire.toml", self.folder / "tire.inp"
        edit(tire, (r"\n\[mesh\]\n", '\n[mesh]\nfaces = ["carcass", "belt_1", "belt_2"]\n'), (r"\nrows_\w+ = .*", ""))
        self.latsch("export", tire, "--ccx", deck, "--deflection", "12 mm", "--modes", "6")
        self.assertIn("*EQUATION", deck.read_text())
        self.assert_says(self.latsch("check", deck), "18 equal sectors")
        # The deck that the program writes again gives the same mesh and results. (A test beside the reader, which can
        # smear cords on such a mesh, compares them with those of the original tire.)
        again = self.folder / "again.inp"
        self.latsch("export", deck, "--ccx", again, "--deflection", "12 mm", "--modes", "6")
        self.assertEqual(again.read_text().count("*EQUATION"), deck.read_text().count("*EQUATION"))
        for test, name in (('{kind = "load_deflection", deflections = ["6 mm", "12 mm"]}', "force"),
                           ('{kind = "modes", count = 6}', "frequency")):
            values = []
            for model in (deck, again):
                answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", model, test, "--json"))
                values.append({c["name"]: c["values"] for c in answer["result"]["channels"]}[name])
            for ours, theirs in zip(*values, strict=True):
                self.assertAlmostEqual(ours / theirs, 1.0, delta=1e-6)

    def test_equations_and_options_that_mean_another_model_are_refused(self):
        deck = self.folder / "tire.inp"
        self.latsch("export", self.folder / "tire.toml", "--ccx", deck, "--deflection", "12 mm", "--modes", "6")
        text = deck.read_text()
        for old, new, *parts in (
                ("*BOUNDARY\n", "*EQUATION\n2\n1,1,1.,2,1,-1.\n*BOUNDARY\n", "an equation of 2 terms"),
                ("*BOUNDARY\n", "*EQUATION\n3\n1,1,1.,2,1,-0.5,3,1,-0.6\n*BOUNDARY\n", "do not add up to 1"),
                ("*BOUNDARY\n", "*EQUATION\n3\n1,1,1.,2,1,-0.5,3,1,-0.5\n*BOUNDARY\n", "in some directions only"),
                ("*NODE,NSET=TIRENODES", "*NODE,NSET=TIRENODES,SYSTEM=C", "*NODE, SYSTEM=C means other than x, y, z"),
                ("*NODE,NSET=TIRENODES", "*NODE,NSETT=TIRENODES", 'NSETT, which is not read here, did you mean "NSET"'),
                ("SYSTEM=CYLINDRICAL", "SYSTEM=SPHERICAL", "*ORIENTATION, SYSTEM=SPHERICAL means other axes"),
                ("*STEP,NLGEOM", "*STEP,NLGEOM=NO", "means small deflections"),
                ("*BOUNDARY\n", "*BOUNDARY,OP=NEW\n", "takes earlier ones away"),
                ("*DLOAD\n", "*DLOAD,AMPLITUDE=A\n", "has the option AMPLITUDE"),
                ("*CONTACT PAIR,", "*CONTACT PAIR,ADJUST=0.1,", "moves nodes onto the ground"),
                ("*SOLID SECTION,", "*SOLID SECTION,COMPOSITE,", "has the option COMPOSITE")):
            deck.write_text(text.replace(old, new, 1))
            self.assert_says(self.latsch("check", deck, code=WRONG_INPUT), "tire.inp:", *parts)
        deck.write_text(text.replace("*STEP,NLGEOM", "*STEP,NAME=A,NLGEOM=YES", 1)
                        .replace("*NODE,NSET=TIRENODES", "*NODE,SYSTEM=R,NSET=TIRENODES", 1))
        self.latsch("check", deck)

    def test_check_of_a_deck_is_a_summary(self):
        deck = self.folder / "tire.inp"
        edit(self.folder / "tire.toml", ('cords = "rebar"', 'cords = "smeared"\nelement = "full_integration"'))
        self.latsch("export", self.folder / "tire.toml", "--ccx", deck)
        said = self.latsch("check", deck)
        self.assertLess(said.count("\n"), 80)
        self.assert_says(said, "D1111 ... D2323 (21)", "latsch show")
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("check", deck, "--json"))
        self.assertGreater(len(answer["result"]["numbers"]), 100)


class PlacedColumns(Coarse):
    def test_numbers_of_sectors_that_need_too_many_unknowns_do_not_lose_those_that_do_not(self):
        """Checks the limit of unknowns: 24 and 26 sectors need at least 3,096 and 3,354 unknowns, 22 sectors 2,838."""
        subprocess.run([LATSCH, "new", self.folder / "co", "--coarse"], check=True, stdout=subprocess.DEVNULL)
        tire, placed = self.folder / "co/tire.toml", self.folder / "placed.toml"
        edit(tire, (r"\n\[mesh\]\n", '\n[mesh]\nfaces = ["carcass", "belt_1", "belt_2"]\n'), (r"\nrows_\w+ = .*", ""))
        self.assert_says(self.latsch("mesh", tire, "--place-columns", placed, "--unknowns", "3000", "--modes", "4",
                                     "--choose-sectors"), "22 sectors, 2838 unknowns")
        self.assertIn("sectors = 22", placed.read_text())
        self.assert_says(self.latsch("mesh", tire, "--place-columns", placed, "--unknowns", "2000", "--modes", "4", code=1),
                         "more than the 2000 allowed")


if __name__ == "__main__":
    unittest.main()
