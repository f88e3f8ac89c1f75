#!/usr/bin/env python3
"""Tests the ledger of a file, the list of how each column was interpreted: names, signs and axes, in show, check, run
and --json.

   ledger_test.py PATH/TO/latsch"""
import json
import math
import pathlib
import resource
import shutil
import subprocess
import tempfile
import time
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
TYRESIDE = 'LEFT'
LONGVL = 16.7
[DIMENSION]
UNLOADED_RADIUS = 0.32
[OPERATING_CONDITIONS]
INFLPRES = 220000
NOMPRES = 220000
[VERTICAL]
FNOMIN = 4000
VERTICAL_STIFFNESS = 200000
[STRUCTURAL]
LONGITUDINAL_STIFFNESS = 300000
LATERAL_STIFFNESS = 100000
[CONTACT_PATCH]
Q_RA1 = 0.6
Q_RB1 = 0.7
[LATERAL_COEFFICIENTS]
PCY1 = 1.3
PDY1 = 1.0
PKY1 = -15
PKY2 = 1.5
RBY1 = 10
RCY1 = 1
[LONGITUDINAL_COEFFICIENTS]
PCX1 = 1.6
PDX1 = 1.1
PKX1 = 20
RBX1 = 12
RCX1 = 1
[ALIGNING_COEFFICIENTS]
QBZ1 = 10
QCZ1 = 1.1
QDZ1 = 0.1
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
STATES = '{{kind = "steady_states", states = "{}"}}'
COMPLIANCE = pathlib.Path(__file__).resolve().parents[3] / "studies" / "compliance"


class Ledger(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_ledger_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "tire.tir").write_text(TIR)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300,
                             cwd=self.folder)
        if code is not None:
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
        """Checks that the lines about files go to standard error if the table goes to standard output, so that a pipe
        gets the table alone."""
        (self.folder / "states.csv").write_text("Fz [N],alpha [deg]\n4000,1\n4000,2\n")
        (self.folder / "steady.toml").write_text('kind = "steady_states"\nstates = "states.csv"\n')
        call = [LATSCH, "test", self.folder / "tire.tir", self.folder / "steady.toml"]
        run = subprocess.run(call, capture_output=True, text=True)
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertNotIn("states.csv", run.stdout)
        for words in ("states.csv: 2 columns: 2 used", "kappa is taken as 0", "tire.tir: "):
            self.assertIn(words, run.stderr)
        self.assertNotIn("steady.toml: ", run.stderr)  # nothing in this file is assumed or unused
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

    def test_a_key_of_columns_that_is_no_channel_is_refused(self):
        for key, meant in {"alpa": "alpha", "gama": "gamma", "kapa": "kappa"}.items():
            text = self.latsch("check", self.study(GOOD, f'columns = {{{key} = "SA"}}'), code=WRONG_INPUT)
            self.assertIn(f'columns has {key} = "SA"', text)
            self.assertIn(f'did you mean "{meant}"?', text)
            self.assertIn("study.toml:5", text)
        text = self.latsch("run", self.study(GOOD, 'columns = {slope_of_road = "TSTC"}'), code=WRONG_INPUT)
        self.assertIn("slope_of_road", text)
        self.assertIn('"tread_center"', text)
        text = self.latsch("check", self.study(GOOD, 'columns = {alpha = "SA", SA = "IA"}'), code=WRONG_INPUT)
        self.assertIn("the same channel", text)
        # A column whose name the user chose, and which the study uses, causes no doubt.
        own = 'columns = {warm = "TSTC"}\n[measurement.m.select]\nwarm = "20 degC .. 90 degC"'
        self.assertIn("Everything is in order", self.latsch("check", self.study(GOOD, own)))

    def test_a_missing_slip_angle_names_every_column_that_may_be_it(self):
        for name in ("Toe", "steer", "Lenkwinkel", "yaw", "Toe angle", "Kanal 7"):
            study = self.study(GOOD.replace("SA [deg]", name + " [deg]"))
            for verb in ("check", "simulate"):
                text = self.latsch(verb, study)
                self.assertIn("alpha is taken as 0", text)
                self.assertIn(f"`{name}`", text)
                self.assertIn(f'columns = {{alpha = "{name}"}}', text)
                self.assertNotIn("gamma is taken as 0:", text)
            said = self.latsch("check", self.study(GOOD.replace("SA [deg]", name + " [deg]"), f'columns = {{alpha = "{name}"}}'))
            self.assertIn("Everything is in order", said)
        text = self.latsch("check", self.study(GOOD.replace("IA [deg]", "IA [deg],SB [deg]").replace(",0,4", ",0,0,4"),
                                               'columns = {gamma = "SA"}'))
        self.assertIn("`SA` (stated to be gamma)", text)
        study = self.study(GOOD.replace("SA [deg]", "steer [deg]"))
        study.write_text(study.read_text().replace('"measurement.m"}', '"measurement.m", without = ["alpha"]}'))
        self.assertIn("Everything is in order", self.latsch("check", study))

    def test_a_missing_slip_names_the_columns_it_can_be_computed_of(self):
        text = self.latsch("check", self.study(GOOD.replace("TSTC [degC]", "N [rpm],V [km/h]").replace(",60\n", ",470,60\n")))
        self.assertIn("kappa is taken as 0", text)
        self.assertIn("`N` (with Vx: kappa = omega R_e / Vx - 1)", text)
        text = self.latsch("check", self.study(GOOD.replace("TSTC [degC]", "SL [%]")))
        self.assertIn("`SL` (slip of the loaded radius", text)
        self.assertNotIn("kappa is taken as 0: ", self.latsch("check", self.study(GOOD.replace("TSTC [degC]", "tan SA [1]"))))

    def test_a_minus_before_a_name_is_applied_and_told(self):
        expected = self.forces(self.study(GOOD))
        turned = "".join(f"{0.1 * i:g},{-a},0,{4000 + i},{-700 * a},60\n" for i, a in enumerate((-3, -2, -1, 1, 2, 3)))
        for title in ("-SA [deg]", "- Slip angle (deg)", "\u2212SA [deg]"):
            head = GOOD.split("\n")[0].replace("SA [deg]", title) + "\n"
            study = self.study(head + turned)
            self.assertEqual(self.forces(study), expected, title)
            for verb in ("check", "run"):
                text = self.latsch(verb, study)
                self.assertIn("begins with a minus, which is applied: alpha is minus", text)
                self.assertNotIn("adapted_sae", text)
        name = "Slip angle"
        stated = self.study((GOOD.split("\n")[0] + "\n").replace("SA [deg]", "- Slip angle [deg]") + GOOD.split("\n", 1)[1],
                            f'columns = {{alpha = "-{name}"}}')
        self.assertEqual(self.forces(stated), expected)
        # A table of states has no columns = {...}, so a minus sign before a name is refused.
        (self.folder / "states.csv").write_text("Fz [N],-SA [deg]\n4000,2\n")
        text = self.latsch("test", self.folder / "tire.tir", '{kind = "steady_states", states = "states.csv"}', code=WRONG_INPUT)
        self.assertIn("change the signs", text)

    def test_signs_that_contradict_are_answered_by_statements_that_remove_it(self):
        """Checks every correction that the message proposes: with it the record is in order."""
        def record(signs):
            rows = []
            for i in range(60):
                alpha, gamma, load = 4 * math.sin(0.3 * i), 2 * (-1) ** (i // 20), 4000 + i
                values = {"FZ": load, "FY": -600 * alpha - 60 * gamma, "MZ": 20 * alpha, "SA": alpha, "IA": gamma}
                rows.append(f"{0.1 * i:.1f}," + ",".join(f"{signs.get(k, 1) * v:.5g}" for k, v in values.items()))
            return "time [s],FZ [N],FY [N],MZ [N m],SA [deg],IA [deg]\n" + "\n".join(rows) + "\n"

        self.assertIn("Everything is in order", self.latsch("check", self.study(record({}))))
        sae = {"FY": -1, "MZ": -1, "SA": -1}  # signs of SAE J670e, except for the sign of the load
        for signs, statements in (({**sae, "FZ": -1}, ['axes = "sae"']),
                                  (sae, ['axes = "sae"\ncolumns = {Fz = "-FZ"}', 'columns = {gamma = "-IA"}']),
                                  ({"FY": -1, "MZ": -1}, ['axes = "adapted_sae"']),
                                  ({"SA": -1}, ['columns = {alpha = "-SA"}']), ({"MZ": -1}, ['columns = {Mz = "-MZ"}']),
                                  ({"IA": -1}, ['columns = {gamma = "-IA"}'])):
            text = self.latsch("check", self.study(record(signs)), code=None)
            for statement in statements:
                for part in statement.split("\n"):
                    self.assertIn(part, text)
                self.assertIn("Everything is in order", self.latsch("check", self.study(record(signs), statement)))
        self.assertIn('columns = {Fz = "-FZ"}', self.latsch("check", self.study(record(sae), 'axes = "sae"'), code=WRONG_INPUT))

    def long_table(self, change=lambda i, row: row):
        """Returns a sweep of 60 samples with a little noise; `change` may damage the fields of a row."""
        rows = []
        for i in range(60):
            alpha = 6 * math.sin(0.15 * i)
            row = [f"{0.1 * i:.1f}", f"{alpha:.4f}", "0", f"{4000 + 7 * math.sin(i * i):.2f}",
                   f"{-600 * alpha + 3 * math.sin(7 * i * i):.2f}", f"{60 + 0.01 * i:.2f}"]
            rows.append(",".join(change(i, row)))
        return GOOD.split("\n")[0] + "\n" + "\n".join(rows) + "\n"

    def test_fillers_are_refused_with_their_rows_and_the_way_out(self):
        self.assertIn("Everything is in order", self.latsch("check", self.study(self.long_table())))
        for column, name, number in ((4, "FY", "-9999"), (4, "FY", "9999"), (4, "FY", "1e30"), (4, "FY", "32767"),
                                     (4, "FY", "-99999.9"), (3, "FZ", "65535"), (1, "SA", "-999")):
            spoiled = self.long_table(lambda i, row: [number if k == column and (i in (7, 30) or 12 <= i <= 15) else field
                                                      for k, field in enumerate(row)])
            study = self.study(spoiled)
            for verb in ("check", "run"):
                text = self.latsch(verb, study, code=WRONG_INPUT)
                self.assertIn(f'"{name}"', text)
                self.assertIn("in 6 of 60 samples (lines 9, 14 to 17, 32)", text)
                self.assertIn("[measurement.m.select]", text)
            window = text.split("[measurement.m.select] ")[1].split(", or cut")[0]
            text = self.latsch("check", self.study(spoiled, "[measurement.m.select]\n" + window))
            self.assertIn("54 steady states", text)
            self.assertIn("Everything is in order", text)
            self.assertIn("in 6 of 60 samples", self.latsch("show", self.folder / "record.csv"))
        # An unreadable value in a channel that nothing uses is only a warning; in a channel of a selection it is an
        # error.
        spoiled = self.long_table(lambda i, row: row[:5] + ["-9999" if i in (3, 4) else row[5]])
        text = self.latsch("check", self.study(spoiled))
        self.assertIn('"TSTC" (tread_center) is -9999 degC in 2 of 60 samples (lines 5, 6)', text)

    def test_a_force_of_many_times_the_load_is_told(self):
        spoiled = self.long_table(lambda i, row: row[:4] + ["-13456.7" if i == 20 else row[4]] + row[5:])
        text = self.latsch("check", self.study(spoiled))
        self.assertIn('"FY" (Fy) is more than 3 times the load Fz in 1 of 60 samples', text)
        self.assertIn("record.csv:22", text)

    def test_a_table_of_states_has_no_fillers(self):
        rows = "".join(f"{4000 + i},{-9999 if i == 3 else 0.1 * i:g}\n" for i in range(12))
        (self.folder / "states.csv").write_text("Fz [N],kappa [%]\n" + rows)
        text = self.latsch("test", self.folder / "tire.tir", '{kind = "steady_states", states = "states.csv"}', code=WRONG_INPUT)
        self.assertIn('"kappa" is -9999 % in 1 of 12 rows (line 5)', text)

    def test_a_turn_slip_that_is_not_used_is_told(self):
        table = GOOD.replace("TSTC [degC]", "phit [1/m]").replace(",60\n", ",0.1\n")
        study = self.study(table)
        text = self.latsch("check", study)
        self.assertIn('column "phit" (phit) is not used', text)
        self.assertIn('turn_slip = "on"', text)
        self.assertNotIn("5 used", text)
        study.write_text(study.read_text().replace('kind = "steady_states"', 'kind = "steady_states"\nturn_slip = "on"'))
        text = self.latsch("check", study)
        self.assertIn("5 used", text)
        self.assertNotIn("is not used:", text)
        (self.folder / "states.csv").write_text("Fz [N],turn slip [1/m]\n4000,0.1\n")
        inline = '{kind = "steady_states", states = "states.csv"}'
        self.assertIn('turn_slip = "on"', self.latsch("test", self.folder / "tire.tir", inline))
        self.assertNotIn("(phit) is not used", self.latsch("test", self.folder / "tire.tir", inline[:-1] + ', turn_slip = "on"}'))
        study.write_text(study.read_text().replace("steady_states", "slip_history").replace('turn_slip = "on"\n', ""))
        self.assertIn("slip_history has no turn slip", self.latsch("check", study))

    def test_time_that_goes_back_or_repeats_is_told(self):
        swapped = self.long_table(lambda i, row: ["9.9" if i == 10 else row[0]] + row[1:])
        text = self.latsch("check", self.study(swapped))
        self.assertIn('"time" goes back in 1 of 60 samples, first from 9.9 to 1.1 s', text)
        self.assertIn("record.csv:13", text)
        twice = self.long_table(lambda i, row: ["1.0" if i == 11 else row[0]] + row[1:])
        self.assertIn("repeats in 1 of 60 samples, first at 1 s", self.latsch("check", self.study(twice)))

    def test_an_operator_in_a_name_makes_another_quantity(self):
        for title in ("|SA| [deg]", "\u0394SA [deg]", "SA*2 [deg]", "(-)SA [deg]"):
            text = self.latsch("check", self.study(GOOD.replace("SA [deg]", title)), code=None)
            self.assertIn(title.split(" [")[0], text)
            self.assertNotIn("Everything is in order", text)

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
    """Checks a table of a K&C rig in the signs of a convention: if its axes are stated, it gives the model's own
    values."""

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


class Cells(unittest.TestCase):
    """Tests cells, headers, units and encodings: which are read, and with which message others are refused."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_ledger_"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "tire.tir").write_text(TIR)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, timeout=300, cwd=self.folder)
        text = (run.stdout + run.stderr).decode("utf-8", "replace")
        if code is not None:
            self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{text}")
        return text

    def check(self, table, code=DONE, more="", name="record.csv"):
        data = table if isinstance(table, bytes) else table.encode()
        (self.folder / name).write_bytes(data)
        (self.folder / "study.toml").write_text(STUDY.format(file=name, more=more))
        return self.latsch("check", self.folder / "study.toml", code=code)

    def states(self, table, code=DONE, name="states.csv"):
        (self.folder / name).write_text(table)
        return self.latsch("test", self.folder / "tire.tir", STATES.format(name), code=code)

    def test_exponents_of_fortran_are_read(self):
        expected = self.states("Fz [N],alpha [deg]\n4000,2\n4000,-2\n")
        self.assertEqual(self.states("Fz [N],alpha [deg]\n4.000000D+03,2.0D0\n0.4d4,-.2D+01\n"), expected)
        self.assertIn("Everything is in order", self.check(GOOD.replace(",-3,", ",-3.0D+00,")))
        dat = "Tire 1\nET\tSA\tFZ\tFY\nsec\tdeg\tN\tN\n0.1D0\t-1.0D0\t9.0D2\t3.0D2\n2.0D0\t2.0D0\t9.0D2\t-6.0D2\n"
        self.assertIn("2 steady states", self.check(dat, name="record.dat"))
        for no_number in ("1.2D", "D+03", "1D2D3", "1.2DEG"):
            self.assertIn(f'"{no_number}" in line 2', self.check(GOOD.replace(",-3,", f",{no_number},"), code=WRONG_INPUT))

    def test_a_cell_that_is_no_number_says_what_it_holds(self):
        for cell, words in {"3 deg": "a number with a unit: write [deg] behind the name",
                            "4°": "a number with a unit", "(3.5": "a negative one begins with a minus",
                            "####": "too narrow", "mean": "a text among numbers", "1'200.5": "thousands separators"}.items():
            text = self.check(GOOD.replace(",-3,", f",{cell},"), code=WRONG_INPUT)
            self.assertIn(f'SA is "{cell}" in line 2', text)
            self.assertIn(words, text)
            self.assertIn("record.csv", text)

    def test_minutes_of_arc_and_a_toe_in_millimeters_are_named(self):
        for title, words in {"SA [min]": '"arcmin"', "SA [sec]": '"arcsec"', "Toe [mm]": "asin(toe / d)"}.items():
            text = self.check(GOOD.replace("SA [deg]", title), code=WRONG_INPUT)
            self.assertIn(words, text)
            self.assertIn(f'is in "{title[title.index("[") + 1:-1]}", expected an angle', text)

    def test_missing_columns_are_answered_with_the_names_of_the_file(self):
        text = self.check("Einfederung [mm],Sturz [deg],Kanal 7 [N]\n1,2,3\n1,2,3\n", code=WRONG_INPUT)
        for part in ('"Einfederung" (deflection)', '"Sturz" (gamma)', '"Kanal 7"'):
            self.assertIn(part, text)
        text = self.states("Last [N],Sturz [deg]\n4000,1\n", WRONG_INPUT)
        self.assertIn('(columns: "Last" or "Sturz")', text)

    def test_a_unit_in_a_name_is_read_everywhere(self):
        expected = self.states("Fz [N],alpha [deg],Vx [km/h]\n4000,2,40\n")
        self.assertEqual(self.states("Fz_kN,SA_deg,V_kmh\n4,2,40\n"), expected)
        self.assertEqual(self.states("FZ_N,slip_angle_deg,Vx_kmh\n4000,2,40\n"), expected)
        (self.folder / "names.csv").write_text("Fz [N],SA_deg\n4000,2\n4000,-2\n")
        shown = self.latsch("show", self.folder / "names.csv")
        self.assertRegex(shown, r"SA_deg +rad")
        self.assertIn("0.0349066", shown)

    def test_full_width_letters_and_brackets_are_read(self):
        expected = self.states("Fz [N],SA [deg]\n4000,2\n")
        self.assertEqual(self.states("Ｆｚ［N］,SA［ｄｅｇ］\n4000,2\n"), expected)
        self.assertEqual(self.states("Fz（N）,SA　（deg）\n4000,2\n"), expected)

    def test_show_fails_where_no_channel_was_read(self):
        (self.folder / "texts.csv").write_text("foo,bar\nx,y\n")
        self.assertIn("no channels", self.latsch("show", self.folder / "texts.csv", code=WRONG_INPUT))
        (self.folder / "good.csv").write_text(GOOD)
        self.latsch("show", self.folder / "good.csv")

    def test_an_assumed_encoding_is_told(self):
        german = GOOD.replace("SA [deg]", "Schräglaufwinkel [°]")
        self.assertNotIn("encoding", self.check(german))
        text = self.check(german.encode("cp1252"))
        self.assertIn("encoding Windows-1252, because the bytes are no UTF-8", text)
        self.assertIn("Everything is in order", text)
        text = self.check(GOOD.replace("TSTC [degC]", "温度 [N]").encode("shift_jis"))
        self.assertIn("they look like Shift-JIS", text)
        self.assertIn("warning", text)

    def test_a_long_and_a_wide_file_end_soon(self):
        rows = 300_000
        line = "4000.5,1.25,-0.5,123.25,7.5,60.5\n"
        (self.folder / "long.csv").write_text("FZ [N],SA [deg],IA [deg],FY [N],MZ [N m],TSTC [degC]\n" + line * rows)
        (self.folder / "wide.csv").write_text(",".join(f"c{i} [N]" for i in range(200_000)) + "\n" + ",".join(["1"] * 200_000) + "\n")
        (self.folder / "broad.csv").write_text(",".join(f"c{i} [N]" for i in range(9_000)) + "\n" + ",".join(["1"] * 9_000) + "\n")
        for name, code in (("long.csv", DONE), ("wide.csv", WRONG_INPUT), ("broad.csv", DONE)):
            begin = time.monotonic()
            text = self.latsch("show", self.folder / name, code=code)
            self.assertLess(time.monotonic() - begin, 60.0, name)
            if name == "wide.csv":
                self.assertIn("more than 10000 fields", text)
        most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024  # MB
        self.assertLess(most, 2000)


if __name__ == "__main__":
    unittest.main()
