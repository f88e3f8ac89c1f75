#!/usr/bin/env python3
"""Tests tables of measurements: structs and constants of MAT files, absolute angles of a K&C rig, messages about
missing columns that say what to state, and `latsch show`, whose channels and ledger agree.

  measured_tables_test.py PATH/TO/latsch"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import doubtful_data_test
from cli_testing import WRONG_INPUT

STUDIES = doubtful_data_test.STUDIES
STEADY = """model = "tire.tir"
[measurement.m]
file = "{file}"
axes = "iso"
{more}
[test.steady]
kind = "steady_states"
states = {{from = "measurement.m"}}
[variable.PDY1]
path = "PDY1"
lower = 0.8
upper = 2
initial = 1.4
[experiment.e]
kind = "curve"
y = "steady/Fy"
measurement = "m"
"""
KC = """model = "front_left.toml"
[measurement.rig]
file = "rig.csv"
axes = "iso"
{more}
[test.A]
kind = "kc"
Fy = {{from = "measurement.rig"}}
[variable.k]
path = "bushing.all.y"
lower = "2 kN/mm"
upper = "400 kN/mm"
initial = "150 kN/mm"
[experiment.toe]
kind = "curve"
x = "A/Fy"
y = "A/toe"
measurement = "rig"
{compare}
"""
MAT = """import numpy as np, scipy.io as io
k = np.arange(60.0)
def run(load):
    rows = {'SA': (6 * np.sin(0.1 * k), 'deg'), 'FZ': (0 * k + load, 'N'), 'FY': (-load * np.sin(0.1 * k), 'N'),
            'P': (0 * k + 82.0, 'kPa')}
    return {name: {'data': data, 'unit': unit} for name, (data, unit) in rows.items()}
io.savemat('two.mat', {'run1': run(3000.0), 'run2': run(4000.0)})
io.savemat('one.mat', {'run': run(3000.0), 'date': 'Monday'})
flat = {name: one['data'] for name, one in run(3000.0).items()}
units = {'name': np.array(list(flat) , dtype=object), 'units': np.array(['deg', 'N', 'N', 'kPa'], dtype=object)}
io.savemat('scalar.mat', dict(flat, P=82.0, channel=units))
io.savemat('plain.mat', dict({name: one for name, one in run(3000.0).items() if name != 'P'}, P=82.0))
"""


class Mat(doubtful_data_test.Data):
    def setUp(self):
        super().setUp()
        self.write("make.py", MAT)
        if subprocess.run(["/usr/bin/python3", "make.py"], cwd=self.folder, capture_output=True).returncode:
            self.skipTest("SciPy is not installed (Debian: python3-scipy)")
        shutil.copy(STUDIES / "tire_model_comparison" / "magic_formula.tir", self.folder / "tire.tir")

    def check(self, file, more="", **options):
        self.write("study.toml", STEADY.format(file=file, more=more))
        return self.latsch("check", "study.toml", **options)

    def test_one_of_several_runs_is_chosen(self):
        said = self.check("two.mat", code=WRONG_INPUT)
        self.assert_says(said, 'say struct = "run1" in [measurement.m]', '"run2"')
        for run, load in (("run1", 3000), ("run2", 4000)):
            self.check("two.mat", f'struct = "{run}"')
            self.assert_says(self.latsch("show", "study.toml"), f"Fz from {load} to {load} N")
        self.assert_says(self.check("two.mat", 'struct = "run3"', code=WRONG_INPUT), "has no struct", '"run1"')
        self.assert_says(self.latsch("show", "two.mat"), 'struct = "run1"', "run2.FZ")
        every = ", ".join(f'{ours} = "run2.{name}"' for ours, name in
                          (("alpha", "SA"), ("Fz", "FZ"), ("Fy", "FY"), ("p", "P")))
        self.check("two.mat", f"columns = {{{every}}}")

    def test_the_only_struct_is_taken_and_told(self):
        self.assert_says(self.check("one.mat"), "struct run, because all known channels are in it", "4 used")

    def test_a_part_of_a_table_is_chosen_by_its_names(self):
        self.write("runs.csv", "a.SA [deg],a.FZ [N],a.FY [N],b.SA [deg],b.FZ [N],b.FY [N]\n"
                   "1,3000,-900,1,4000,-1200\n2,3000,-1800,2,4000,-2400\n3,3000,-2500,3,4000,-3300\n")
        self.check("runs.csv", 'struct = "b"')
        self.assert_says(self.latsch("show", "study.toml"), "Fz from 4000 to 4000 N")
        self.assert_says(self.check("runs.csv", 'struct = "c"', code=WRONG_INPUT), 'begins with "c."', '"a.SA"')
        self.write("run.dat", "SA\tFZ\ndeg\tN\n1\t3000\n")
        self.assert_says(self.check("run.dat", 'struct = "b"', code=WRONG_INPUT), "has no structs")

    def test_a_single_number_with_a_unit_is_a_constant(self):
        said = self.check("scalar.mat")
        self.assertNotIn("INFLPRES of the tire", said)
        self.assert_says(self.latsch("show", "scalar.mat"), "one number for all samples")
        self.assert_says(self.check("plain.mat", code=WRONG_INPUT), "is a single number, 82, without a unit",
                         'columns = {p = "P [kPa]"}')
        self.check("plain.mat", 'columns = {p = "P [kPa]"}')
        self.assert_says(self.latsch("show", "study.toml"), "p from 82 to 82 kPa")


class KcRig(doubtful_data_test.Data):
    def setUp(self):
        super().setUp()
        shutil.copy(STUDIES / "compliance" / "front_left.toml", self.folder)

    def check(self, toe=0.0, head="Fy [N],toe [deg]", more="", compare="", loads=range(-4000, 4001, 1000), **options):
        rows = "".join(f"{F},{toe - 1.7e-5 * F:.6f}\n" for F in loads)
        self.write("rig.csv", head + "\n" + rows)
        self.write("study.toml", KC.format(more=more, compare=compare))
        return self.latsch("check", "study.toml", **options)

    def test_absolute_angles_are_told_with_the_way_out(self):
        self.assertNotIn("without load", self.check())
        said = self.check(toe=0.25)
        zero = 'zero = {channels = ["toe"], at = {Fy = "0 N +- 202 N"}}'
        self.assert_says(said, "without load toe is 0.25 deg", zero)
        self.assertNotIn("warning", self.check(toe=0.25, more=zero))
        self.assert_says(self.latsch("show", "study.toml"), "the mean of 1 samples")
        self.assertNotIn("without load", self.check(toe=0.25, compare='compare = "about_mean"'))

    def test_a_table_without_a_sample_at_rest_is_told_too(self):
        said = self.check(toe=-0.3, loads=(-4000, -3000, -2000, 2000, 3000, 4000))
        self.assert_says(said, "without load toe is -0.3 deg", 'compare = "about_mean"')
        self.assertNotIn("zero =", said)

    def test_a_zero_needs_samples_and_channels_that_exist(self):
        for at, part in (('{Fy = "9 kN .. 10 kN"}', "holds no sample"), ('{Fq = "0 N +- 1 N"}', "is no channel"),
                         ('{Fy = "0 deg +- 1 deg"}', "expected a window in N")):
            said = self.check(more=f'zero = {{channels = ["toe"], at = {at}}}', code=WRONG_INPUT)
            self.assert_says(said, part)

    def test_a_missing_angle_is_named_with_the_columns_that_may_be_it(self):
        for name in ("toe_left", "toe-in", "toe_L"):
            said = self.check(head=f"Fy [N],{name} [deg]", code=WRONG_INPUT)
            self.assert_says(said, 'column "toe" is missing', f'columns = {{toe = "{name}"}}')
        self.check(head="Fy [N],toe_left [deg]", more='columns = {toe = "toe_left"}')
        said = self.check(head="Fy_L [N],toe [deg]", code=WRONG_INPUT)
        self.assert_says(said, 'column "Fy" is missing', 'columns = {Fy = "Fy_L"}')
        self.assert_says(self.check(head="Fy [N],toe [']", code=WRONG_INPUT), '"arcmin"')


    def test_loads_are_taken_at_the_point_of_their_frame(self):
        for head, at, part in (("FyH", "", 'at = "wheel_center"'), ("FyC", "", 'in_frame = "W"'),
                               ("FyW", 'at = "wheel_center"', 'at = "contact_patch"')):
            self.write("rig.csv", f"{head} [N],toe [deg]\n-1000,0.1\n0,0\n1000,-0.1\n2000,-0.2\n")
            study = KC.format(more="", compare="").replace('kind = "kc"', f'kind = "kc"\n{at}')
            self.write("study.toml", study)
            self.assert_says(self.latsch("check", "study.toml", code=WRONG_INPUT), "study.toml", part)
        self.write("study.toml", study.replace(at, ""))
        self.latsch("check", "study.toml")

    def test_slopes_in_other_axes_are_answered_with_the_axes_first(self):
        self.check()
        slopes = '[measurement.s]\nfile = "slopes.csv"\n'
        self.write("slopes.csv", "toe_by_Mz [deg/(N m)],camber_by_Fy [deg/kN]\n" + "0.01,0.02\n" * 5)  # SAE J670e
        self.write("study.toml", KC.format(more="", compare="") + slopes)
        said = self.latsch("check", "study.toml")
        self.assert_says(said, "has the signs of a right wheel", 'say axes = "sae"; or', 'toe_by_Mz = "-toe_by_Mz"',
                         'camber_by_Fy = "-camber_by_Fy"')
        self.write("study.toml", KC.format(more="", compare="") + slopes + 'axes = "sae"\n')
        self.assertNotIn("has the signs of", self.latsch("check", "study.toml"))

    def test_a_displacement_in_another_unit_is_told(self):
        # displacement in mm: the stiffness is 50 kN/mm
        rows = "".join(f"{F},{2e-5 * F:.6f}\n" for F in range(-4000, 4001, 1000))
        compare = '[experiment.dy]\nkind = "curve"\nx = "A/Fy"\ny = "A/dy"\nmeasurement = "rig"\n'
        for unit, told in (("mm", False), ("m", True)):
            self.write("rig.csv", f"Fy [N],dy [{unit}],toe [deg]\n" + rows.replace("\n", ",0.01\n").replace("4000,0.08,0.01", "4000,0.08,0.02"))
            self.write("study.toml", KC.format(more="", compare=compare))
            self.assertEqual("has a stiffness of" in self.latsch("check", "study.toml"), told, unit)


class Curves(doubtful_data_test.Data):
    STUDY = doubtful_data_test.STUDY.split("[test.pressed]")[0] + """[variable.k]
path = "VERTICAL_STIFFNESS"
lower = "150 N/mm"
upper = "250 N/mm"
initial = "180 N/mm"
[experiment.c]
kind = "load_deflection"
measurement = "m.csv"
"""

    def target(self, table, **options):
        shutil.copy(doubtful_data_test.TIR, self.folder / "base.tir")
        self.write("m.csv", table)
        self.write("study.toml", self.STUDY)
        said = self.latsch("simulate", "study.toml", "--json", **options)
        return said if options else json.loads(said[said.index("{"):said.rindex("}") + 1])["result"]["target"]

    def test_a_curve_under_other_names_is_the_same_curve(self):
        plain = self.target("deflection [mm],force [N]\n10,1600\n20,3400\n30,5200\n")
        for other in ("Einfederung [mm],Radlast [N]\n10,1600\n20,3400\n30,5200\n",
                      "Vertical Deflection (mm),Vertical Load (kN)\n10,1.6\n20,3.4\n30,5.2\n",
                      "Fz [N],deflection [mm],note [-]\n1600,10,1\n3400,20,1\n5200,30,1\n"):
            self.assertAlmostEqual(self.target(other) / plain, 1.0, delta=1e-9)
        self.latsch("check", "study.toml")
        self.assert_says(self.target("dz [mm],Fz [N]\n10,1600\n20,3400\n", code=WRONG_INPUT),
                         'column "deflection" is missing')

    def test_statements_without_effect_are_told(self):
        self.target("deflection [mm],force [N]\n10,1600\n20,3400\n30,5200\n")
        for more, part in (('noise = "100 kN"\n', "more than the largest measured value"),
                           ('[tie.a]\npath = "LATERAL_STIFFNESS"\nfollows = "k"\nfactor = 0\n', "with factor 0")):
            self.write("study.toml", self.STUDY + more)
            self.assert_says(self.latsch("check", "study.toml"), "warning", part)
        self.write("study.toml", self.STUDY.replace('initial = "180 N/mm"',
                                                    'initial = "180 N/mm"\nprior = "300 N/mm"\nprior_sigma = "5 N/mm"')
                   + 'noise = "20 N"\n')
        self.assert_says(self.latsch("check", "study.toml"), "warning", "outside of its bounds")
        self.write("m.csv", "deflection [mm],force [N]\n10,1600\n")
        self.write("study.toml", self.STUDY + '[variable.R]\npath = "UNLOADED_RADIUS"\nlower = "0.3 m"\nupper = "0.34 m"\n'
                                              'initial = "0.32 m"\n')
        self.assert_says(self.latsch("check", "study.toml"), "warning", "1 value is fitted for 2 variables")


class Show(doubtful_data_test.Data):
    def rows(self, table):
        self.write("t.csv", table)
        said = self.latsch("show", "t.csv", "--json")
        tables = json.loads(said)["result"]["tables"]
        channels, ledger = ([one for one in tables if one["title"].startswith(title)][0]
                            for title in ("Channels, in SI", "Ledger of"))
        return {row[0]: row for row in channels["rows"]}, {row[0]: row for row in ledger["rows"]}

    def test_channels_and_ledger_come_from_one_reading(self):
        table = "time [s],Fz [N],Mz [oz-in],Vx [kn],SA [']\n" + "".join(
            f"{0.1 * k:g},4000,{1000 * math.sin(k):.3f},40,{60 * math.sin(k):.4f}\n" for k in range(20))
        channels, ledger = self.rows(table)
        for name, unit in (("Mz", "N m"), ("Vx", "m/s"), ("SA", "rad")):
            self.assertEqual(channels[name][1], unit)
            self.assertEqual(ledger[name][4].split(",")[0], unit)
        self.assertAlmostEqual(float(channels["Vx"][4]), 40 * 1852 / 3600, delta=1e-3)
        self.assertAlmostEqual(float(channels["Mz"][6]), 7.06155e-3 * 1000 * max(math.sin(k) for k in range(20)), delta=1e-2)

    def test_the_factor_of_a_tydex_file_is_in_the_ledger(self):
        line = "{:<10}{:<30}{:<10}{:<10}{:<10}{:<10}\n".format
        self.write("t.tdx", "**HEADER\nRELEASE   Release of TYDEX-Format                 1.3\n**CONSTANTS\n"
                   "**MEASURCHANNELS\n" + line("SLIPANGL", "Slip angle", "deg", "1", "0", "0")
                   + line("FZW", "Load", "kN", "-1", "0", "0.5") + "**MEASURDATA  2\n1 -3\n2 -3.5\n**END\n")
        result = json.loads(self.latsch("show", "t.tdx", "--json"))["result"]
        row = next(one for one in result["ledgers"][0]["rows"] if one["written"] == "FZW")
        self.assertEqual((row["factor"], row["offset"]), (-1000.0, 500.0))
        loads = next(one for one in result["tables"] if one["title"] == "Channels, in SI")["rows"]
        self.assertEqual([float(row[4]) for row in loads if row[0] == "FZW"], [3500.0])


if __name__ == "__main__":
    unittest.main()
