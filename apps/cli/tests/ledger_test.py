#!/usr/bin/env python3
"""What a file is taken for: the ledger in show, check, run and --json; names, signs and axes that are not silent.

    ledger_test.py PATH/TO/latsch
"""
import json
import pathlib
import shutil
import subprocess
import tempfile
import tomllib
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT

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
PCY1 = 1.3
PDY1 = 1.0
PKY1 = -15
PKY2 = 1.5
PCX1 = 1.6
PDX1 = 1.1
PKX1 = 20
"""
STUDY = """model = "tire.tir"
vary = ["PDY1"]
[measurement.m]
file = "{file}"
{more}
[test.steady]
kind = "steady_states"
states = {{from = "measurement.m"}}
[experiment.fy]
kind = "curve"
y = "steady/Fy"
measurement = "m"
"""
GOOD = "time [s],SA [deg],IA [deg],FZ [N],FY [N],TSTC [degC]\n" + "".join(
    f"{0.1 * i:g},{a},0,{4000 + i},{-700 * a},60\n" for i, a in enumerate((-3, -2, -1, 1, 2, 3)))
COMPLIANCE = pathlib.Path(__file__).resolve().parents[3] / "studies" / "compliance"


class Ledger(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_ledger_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "tire.tir").write_text(TIR)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout + run.stderr

    def study(self, table, more="", name="record.csv"):
        (self.folder / name).write_text(table, encoding="utf-8")
        file = self.folder / "study.toml"
        file.write_text(STUDY.format(file=name, more=more))
        return file

    def forces(self, study):
        answer = json.loads(subprocess.run([LATSCH, "simulate", study, "--json"], capture_output=True, text=True).stdout)
        return answer["result"]["experiments"][0]["curve"]["simulated"]

    def test_the_head_of_a_test_says_what_was_read_and_assumed(self):
        """On standard error where the table goes to standard output, so that a pipe gets the table alone."""
        (self.folder / "states.csv").write_text("Fz [N],alpha [deg]\n4000,1\n4000,2\n")
        (self.folder / "steady.toml").write_text('kind = "steady_states"\nstates = "states.csv"\n')
        call = [LATSCH, "test", self.folder / "tire.tir", self.folder / "steady.toml"]
        run = subprocess.run(call, capture_output=True, text=True)
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertNotIn("states.csv", run.stdout)
        for words in ("states.csv: 2 columns: 2 used", "kappa is taken as 0", "tire.tir: "):
            self.assertIn(words, run.stderr)
        self.assertNotIn("steady.toml: ", run.stderr)  # all of it is used as written
        said = self.latsch(*call[1:], "-o", self.folder / "out.csv")
        for words in ("kappa is taken as 0", "tire.tir: ", "steady.toml: "):
            self.assertIn(words, said)
        self.assertNotIn("2 columns", subprocess.run([*call, "--quiet"], capture_output=True, text=True).stderr)
        answer = json.loads(subprocess.run([*call, "--json"], capture_output=True, text=True).stdout)["result"]
        self.assertEqual({pathlib.Path(one["file"]).name for one in answer["ledgers"]},
                         {"states.csv", "tire.tir", "steady.toml"})

    def test_validate_and_compare_say_what_was_read_and_assumed(self):
        (self.folder / "states.csv").write_text("Fz [N],alpha [deg]\n4000,1\n4000,2\n")
        suite = self.folder / "suite.toml"
        suite.write_text('[test.s]\nkind = "steady_states"\nstates = "states.csv"\n'
                         '[check.c]\nchannel = "s/Fy"\nof = "first"\nupper = "9 kN"\nsource = "by hand"\n')
        said = self.latsch("validate", self.folder / "tire.tir", suite)
        for words in ("Files", "states.csv: 2 columns: 2 used", "kappa is taken as 0", "tire.tir: "):
            self.assertIn(words, said)
        for studies, names in (("tire_model_comparison", ("slow.toml", ".tir: ")), ("kerb", ("baseline.toml", "exit.toml"))):
            with self.subTest(studies):
                comparison = COMPLIANCE.parent / studies / "comparison.toml"
                run = subprocess.run([LATSCH, "compare", comparison, "--write-measurements", "/dev/null/none"],
                                     capture_output=True, text=True)
                self.assertNotEqual(run.returncode, DONE)
                for name in names:
                    self.assertIn(name, run.stdout)

    def test_check_counts_the_columns_of_a_file(self):
        text = self.latsch("check", self.study(GOOD))
        self.assertIn("record.csv: 6 columns: 4 used, 2 not used (`time`, `TSTC`)", text)
        self.assertIn("kappa is taken as 0 by test steady", text)
        self.assertIn("Everything is in order", text)
        rows = json.loads(self.latsch("check", self.study(GOOD), "--json"))["result"]["ledgers"][0]["rows"]
        alpha = next(row for row in rows if row["written"] == "SA")
        self.assertEqual([alpha[key] for key in ("taken_as", "unit_written", "unit", "used_by", "state")],
                         ["alpha", "deg", "rad", ["test steady"], "used"])
        self.assertAlmostEqual(alpha["factor"], 0.017453292519943295, delta=1e-15)
        shown = self.latsch("show", self.folder / "study.toml")
        self.assertIn("Ledger of record.csv", shown)
        self.assertIn("experiment fy", shown)

    def test_show_prints_the_ledger_of_a_file(self):
        self.study(GOOD)
        text = self.latsch("show", self.folder / "record.csv")
        self.assertIn("Ledger of record.csv", text)
        self.assertIn("slip angle", text)
        (self.folder / "run.dat").write_text("Tire 1\nET\tSA\tFZ\tFY\nsec\tdeg\tN\tN\n0\t1\t-900\t-300\n1\t2\t-900\t-600\n")
        text = self.latsch("show", self.folder / "run.dat")
        self.assertIn("? ", text)
        self.assertIn("sae", text)
        self.assertNotIn("below 0", self.latsch("show", self.folder / "run.dat", "--axes", "sae"))

    def test_spellings_of_a_channel_give_the_same_numbers(self):
        expected = self.forces(self.study(GOOD))
        for spelling in ("alpha", "Alpha", "SLIPANGL", "SlipAngle", "slip angle", "slip_angle", "Schräglaufwinkel"):
            self.assertEqual(self.forces(self.study(GOOD.replace("SA [", spelling + " ["))), expected, spelling)
        for spelling in ("Normal load", "Radlast", "FZW", "fz", "vertical load"):
            self.assertEqual(self.forces(self.study(GOOD.replace("FZ [", spelling + " ["))), expected, spelling)

    def test_a_slip_angle_is_never_left_out_silently(self):
        for name, parts in {"SA": ['"SA"', "unit"], "Alhpa [deg]": ['"Alhpa"', 'columns = {alpha = "Alhpa"}', "without"],
                            "SA [N]": ['"SA"', "angle"]}.items():
            text = self.latsch("check", self.study(GOOD.replace("SA [deg]", name)), code=WRONG_INPUT)
            for part in parts:
                self.assertIn(part, text)
        study = self.study(GOOD.replace("SA [deg]", "Kanal 7 [deg]"))
        for verb in ("check", "simulate"):
            text = self.latsch(verb, study)
            self.assertIn("alpha is taken as 0", text)
            self.assertIn("`Kanal 7`", text)

    def test_a_table_of_states_is_as_strict(self):
        def answer(table, code=DONE):
            (self.folder / "states.csv").write_text(table)
            run = subprocess.run([LATSCH, "test", self.folder / "tire.tir", self.folder / "steady.toml"],
                                 capture_output=True, text=True)
            self.assertEqual(run.returncode, code, run.stdout + run.stderr)
            return run.stdout, run.stderr
        (self.folder / "steady.toml").write_text('kind = "steady_states"\nstates = "states.csv"\n')
        expected = answer("Fz [N],alpha [deg]\n4000,2\n")[0]
        self.assertEqual(answer("FZ [N],SA [deg]\n4000,2\n")[0], expected)
        self.assertEqual(answer("Radlast [N],Slip Angle [deg]\n4000,2\n")[0], expected)
        self.assertIn('"SA" has no unit', answer("Fz [N],SA\n4000,2\n", WRONG_INPUT)[1])
        self.assertIn("Alhpa", answer("Fz [N],Alhpa [deg]\n4000,2\n", WRONG_INPUT)[1])
        self.assertIn("both are alpha", answer("Fz [N],alpha [deg],SA [deg]\n4000,2,2\n", WRONG_INPUT)[1])
        self.assertIn("alpha is taken as 0", answer("Fz [N],Kanal 7 [deg]\n4000,2\n")[1])
        self.assertIn("below 0", answer("Fz [N],alpha [deg]\n-4000,2\n-4000,1\n", WRONG_INPUT)[1])

    def test_loads_below_zero_are_refused_with_the_way_out(self):
        turned = GOOD.replace(",40", ",-40")
        text = self.latsch("check", self.study(turned), code=WRONG_INPUT)
        self.assertIn("below 0", text)
        self.assertIn("sae", text)
        self.latsch("run", self.folder / "study.toml", code=WRONG_INPUT)
        self.latsch("check", self.study(turned, 'axes = "sae"'))

    def test_ranges_are_checked_and_named(self):
        text = self.latsch("check", self.study(GOOD.replace("IA [deg],", "IA [deg],P [Pa],").replace(",0,4", ",0,80,4")),
                           code=WRONG_INPUT)
        self.assertIn('"P"', text)
        text = self.latsch("check", self.study(GOOD.replace("\n0,-3,0,4000", "\n0,-3,0,-4000")))
        self.assertIn("in 1 of 6 samples", text)
        self.assertIn("in doubt", text)

    def test_two_columns_for_one_channel_are_named(self):
        text = self.latsch("check", self.study(GOOD.replace("IA [deg]", "alpha [deg]")), code=WRONG_INPUT)
        self.assertIn('"SA" and "alpha"', text)
        self.latsch("check", self.study(GOOD.replace("IA [deg]", "alpha [deg]"), 'columns = {alpha = "SA"}'))

    def test_two_files_of_one_name_are_told_apart(self):
        for folder, load in (("a", 4000), ("b", 2000)):
            (self.folder / folder).mkdir()
            (self.folder / folder / "x.csv").write_text(GOOD.replace("400", str(load)[:3]))
        text = STUDY.format(file="a/x.csv", more="") + STUDY.split("vary")[1].split("\n", 1)[1].format(
            file="b/x.csv", more="").replace("[measurement.m]", "[measurement.n]").replace(
                "[test.steady]", "[test.slow]").replace("measurement.m", "measurement.n").replace(
                    "[experiment.fy]", "[experiment.low]").replace("steady/Fy", "slow/Fy").replace(
                        'measurement = "m"', 'measurement = "n"')
        study = self.folder / "study.toml"
        study.write_text(text)
        said = self.latsch("check", study)
        self.assertIn("a/x.csv: 6 columns", said)
        self.assertIn("b/x.csv: 6 columns", said)
        files = [ledger["file"] for ledger in json.loads(self.latsch("check", study, "--json"))["result"]["ledgers"]]
        self.assertEqual(sum(file.endswith("a/x.csv") for file in files), 1)
        self.assertEqual(sum(file.endswith("b/x.csv") for file in files), 1)


class AxesOfARig(unittest.TestCase):
    """A table of a K&C rig, written in the signs of a convention, is the model's own again when its axes are stated."""

    def test_a_table_in_sae_axes_is_turned_whole(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_ledger_"))
        self.addCleanup(shutil.rmtree, folder)
        for file in COMPLIANCE.glob("*.toml"):
            shutil.copy(file, folder)
        loads = "Fx = [\"0 N\", \"500 N\", \"1 kN\"], Fy = [\"0 N\", \"-2 kN\", \"-4 kN\"], Fz = [\"1 kN\", \"2 kN\", \"3 kN\"]"
        run = lambda *arguments: subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True)
        moved = ("dx", "dy", "dz", "camber", "toe", "caster")
        for axes in ("sae", "adapted_sae"):
            written = run("test", folder / "front_left.toml", "{kind = \"kc\", " + loads + "}", "--signs", "sae",
                          "-o", folder / "rig.csv")
            self.assertEqual(written.returncode, 0, written.stderr)
            if axes == "adapted_sae":  # adapted_sae keeps loads positive
                lines = (folder / "rig.csv").read_text().splitlines()
                place = [name.split(" [")[0] for name in lines[0].split(",")].index("Fz")
                rows = [line.split(",") for line in lines[1:]]
                for row in rows:
                    row[place] = repr(-float(row[place]))
                (folder / "rig.csv").write_text("\n".join([lines[0], *(",".join(row) for row in rows)]) + "\n")
            bushing = tomllib.loads((folder / "front_left.toml").read_text())["bushing"]["all"]["x"]
            variable = (f'[variable.x]\npath = "bushing.all.x"\nlower = "1 kN/mm"\nupper = "1000 kN/mm"\ninitial = "{bushing}"\n'
                        'scale = "logarithmic"\n')
            experiments = "".join(f'[experiment.{name}]\nkind = "curve"\ny = "kc/{name}"\nmeasurement = "rig"\n' for name in moved)
            (folder / "axes_study.toml").write_text(
                f'model = "front_left.toml"\n[measurement.rig]\nfile = "rig.csv"\naxes = "{axes}"\n'
                '[test.kc]\nkind = "kc"\nloads = {from = "measurement.rig"}\n' + variable + experiments)
            done = run("simulate", folder / "axes_study.toml", "--json")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertLess(json.loads(done.stdout)["result"]["target"], 1e-9, axes)


if __name__ == "__main__":
    unittest.main()
