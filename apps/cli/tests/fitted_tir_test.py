#!/usr/bin/env python3
"""Tests that the file of a fitted tire states the source of each number, and that reading it gives the same tire. The
recordings belong to a tire with known coefficients and were computed by the program's own test of steady states.

   fitted_tir_test.py PATH/TO/latsch"""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT

TRUTH = {"PCY1": 1.5, "PDY1": 1.25, "PEY1": -0.8, "PKY1": -32.0, "PDY2": -0.12, "PKY2": 1.9, "PPY1": 0.4, "PPY3": -0.3,
         "QBZ1": 9.0, "QCZ1": 1.05, "QDZ1": 0.11, "QEZ1": -1.5}
BASE = """[MDI_HEADER]
FILE_TYPE = 'tir'
[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
PRESSURE = 'pascal'
[MODEL]
FITTYP = 61
LONGVL = 11.11
[DIMENSION]
UNLOADED_RADIUS = 0.2032
[OPERATING_CONDITIONS]
INFLPRES = 83000
NOMPRES = 83000
[VERTICAL]
FNOMIN = 1600
VERTICAL_STIFFNESS = 218000
"""
STUDY = """title = "of one force"
model = "tire.tir"
vary = ["PDY1", "PKY1"{free}]
measurement.cornering = {{file = "record.csv", select = {{p = "60 kPa .. 90 kPa"}}}}
measurement.held = {{file = "record.csv", select = {{p = "90 kPa .. 110 kPa"}}}}
test.cornering = {{kind = "steady_states", states = {{from = "measurement.cornering"}}}}
test.held = {{kind = "steady_states", states = {{from = "measurement.held"}}}}
experiment.Fy = {{kind = "curve", y = "cornering/Fy", measurement = "cornering", exponent = 2}}
experiment.Fy_97 = {{kind = "curve", y = "held/Fy", measurement = "held", exponent = 2, use = "predict"}}
{more}
[run]
workers = 1
"""


def keys_of(text):
    """Returns {key: (value, remark)} of a .tir file, without the sections [MDI_HEADER] and [UNITS]."""
    found = {}
    text = text[text.index("[MODEL]"):]
    for line in text.splitlines():
        match = re.match(r"([A-Z_0-9]+)\s*=\s*(\S+)\s*(?:\$ (.*))?$", line)
        if match:
            found[match[1]] = (match[2].strip("'"), match[3] or "")
    return found


class FittedTir(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_fitted_tir_"))
        (cls.base / "truth.tir").write_text(BASE + "[COEFFICIENTS]\n" + "".join(f"{k} = {v}\n" for k, v in TRUTH.items()))
        states = [(Fz, 12.0 * math.sin(2 * math.pi * i / 21), p) for p in (69, 83, 97) for Fz in (500, 1600, 2600)
                  for i in range(21)]
        (cls.base / "states.csv").write_text(
            "Fz [N],alpha [deg],p [kPa],Vx [km/h]\n" + "".join(f"{F},{a!r},{p},40\n" for F, a, p in states))
        (cls.base / "steady.toml").write_text('kind = "steady_states"\nstates = "states.csv"\n')
        subprocess.run([LATSCH, "test", cls.base / "truth.tir", cls.base / "steady.toml", "-o", cls.base / "truth.csv",
                        "--quiet"], check=True)
        with open(cls.base / "truth.csv") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        at = [cell.split(" ")[0] for cell in rows[0]]
        lines = ["time [s],Vx [km/h],alpha [deg],gamma [deg],p [kPa],loaded_radius [m],Fz [N],Fy [N],Mz [N m]"]
        for i, ((F, a, p), row) in enumerate(zip(states, rows[1:])):
            lines.append(f"{0.1 * i:g},40,{a!r},0,{p},{0.2032 - F / 218e3!r},{F},{row[at.index('Fy')]},"
                         f"{row[at.index('Mz')]}")
        (cls.base / "record.csv").write_text("\n".join(lines) + "\n")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.base)

    def latsch(self, *arguments, code=DONE, date="1767225600"):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300,
                             env={**os.environ, "SOURCE_DATE_EPOCH": date})
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run

    def study(self, name, tire, free="", more=""):
        folder = self.base / name
        folder.mkdir()
        shutil.copy(self.base / "record.csv", folder)
        (folder / "tire.tir").write_text(tire)
        (folder / "study.toml").write_text(STUDY.format(free=free, more=more))
        return folder

    def tire(self, **other):
        """Returns the true coefficients, except for the two that the studies here identify."""
        known = {**TRUTH, "PDY1": 1.1, "PKY1": -25.0, **other}
        return BASE + "[COEFFICIENTS]\n" + "".join(f"{k} = {v}\n" for k, v in known.items())

    def test_fitted_kept_and_assumed_are_told_apart(self):
        folder = self.study("kept", self.tire())
        self.latsch("run", folder / "study.toml")
        self.latsch("export", folder / "study.toml", "--model", folder / "fitted.tir")
        text = (folder / "fitted.tir").read_text()
        keys = keys_of(text)
        self.assertRegex(keys["PDY1"][1], r"^fitted 1\.25\d* \+- \S+ \(95 %\)")
        self.assertRegex(keys["PKY1"][1], r"^fitted -(32|31\.9)")
        self.assertEqual(keys["PEY1"][1], "kept from tire.tir")
        self.assertEqual(keys["FNOMIN"][1], "kept from tire.tir")
        self.assertEqual(keys["USE_MODE"][1], "assumed, default of Latsch")
        self.assertIn("exported by Latsch", text)
        self.assertIn("on 2026-01-01", text)
        self.assertIn("of one force", text)
        self.assertRegex(text, r"\$ Target: ")
        self.assertRegex(text, r"\$ +Fy: RMS error .* record.csv")
        self.assertRegex(text, r"Held out, not fitted:\n\$ +Fy_97: RMS error ")

    def test_the_report_tells_assumed_curves_and_what_lies_outside(self):
        assumed = {k: f"{v} $ assumed by hand" for k, v in (("PCX1", 1.5), ("PDX1", 1.2), ("PKX1", 20.0))}
        folder = self.study("drawn", self.tire(**assumed))
        self.latsch("run", folder / "study.toml")
        page = (folder / "study.html").read_text()
        figures = {text.split("</")[0]: text for text in re.split(r"<figure[^>]*>", page)}
        of = {name: next(t for t in figures.values() if name in t) for name in
              ("Fx over kappa, by load", "Fy over alpha, by load", "Mz over alpha, by load")}
        self.assertIn("stroke-dasharray", of["Fx over kappa, by load"])
        self.assertIn("N, assumed", of["Fx over kappa, by load"])
        # One coefficient is fitted, the other keeps the value in tire.tir.
        for known in ("Fy over alpha, by load", "Mz over alpha, by load"):
            self.assertNotIn(", assumed", of[known])
            self.assertIn('class="outside"', of[known])

    def test_ranges_are_those_of_the_fitted_samples(self):
        folder = self.study("ranges", self.tire())
        self.latsch("run", folder / "study.toml")
        self.latsch("export", folder / "study.toml", "--model", folder / "fitted.tir")
        text = (folder / "fitted.tir").read_text()
        keys = keys_of(text)
        most = max(abs(math.sin(2 * math.pi * i / 21)) for i in range(21)) * math.radians(12.0)
        for key, value in (("FZMIN", 500), ("FZMAX", 2600), ("ALPMIN", -most), ("ALPMAX", most), ("PRESMIN", 69e3),
                           ("PRESMAX", 83e3)):  # the samples at 97 kPa are held out
            self.assertAlmostEqual(float(keys[key][0]) / value, 1.0, places=12, msg=key)
            self.assertEqual(keys[key][1], "from the data")
        self.assertNotIn("CAMMIN", keys)  # with a single camber angle there is no range, and the file says so
        self.assertRegex(text, r"\[INCLINATION_ANGLE_RANGE\]\n\$ no range from the data: they have only one camber, 0 to 0 deg")
        self.assertRegex(text, r"\[LONG_SLIP_RANGE\]\n\$ no range from the data: ")
        self.assertIn("without a margin", text)
        self.assertRegex(text, r"speeds of the data: 11\.11 to 11\.11 m/s")

    def test_the_file_is_read_to_the_same_tire(self):
        """Tests that the fitted file can be the model of another study, which leaves the fitted coefficients
        unchanged."""
        folder = self.study("again", self.tire())
        run = json.loads(self.latsch("run", folder / "study.toml", "--json").stdout)
        found = {v["name"]: v["value"] for v in run["result"]["variables"]}
        self.latsch("export", folder / "study.toml", "--model", folder / "fitted.tir")
        keys = keys_of((folder / "fitted.tir").read_text())
        for name, value in found.items():
            self.assertEqual(float(keys[name][0]), value, name)
        check = json.loads(self.latsch("check", folder / "fitted.tir", "--json").stdout)["result"]["numbers"]
        read = {number["path"]: number["value"] for number in check}
        for name, (value, _) in keys.items():
            if name in read:
                self.assertEqual(read[name], float(value), name)
        self.latsch("export", folder / "fitted.tir", "--model", folder / "copy.tir")
        copy = keys_of((folder / "copy.tir").read_text())
        self.assertEqual({k: v for k, (v, _) in copy.items()}, {k: v for k, (v, _) in keys.items()})
        following = self.study("following", (folder / "fitted.tir").read_text(), more="")
        text = (following / "study.toml").read_text().replace('"PDY1", "PKY1"', '"PEY1"')
        (following / "study.toml").write_text(text)
        self.latsch("run", following / "study.toml")
        self.latsch("export", following / "study.toml", "--model", following / "fitted.tir")
        self.assertRegex(keys_of((following / "fitted.tir").read_text())["PDY1"][1], r"^kept from tire\.tir: fitted 1\.25")

    def test_what_the_data_do_not_tell_is_assumed(self):
        folder = self.study("untold", self.tire(), free=', "PPY4", "PKY6"')
        said = self.latsch("check", folder / "study.toml").stderr
        self.assertIn("PPY4 is of order 2 in the pressure", said)
        self.latsch("run", folder / "study.toml")
        self.latsch("export", folder / "study.toml", "--model", folder / "fitted.tir")
        keys = keys_of((folder / "fitted.tir").read_text())
        for name, why in (("PPY4", "of order 2 in the pressure"), ("PKY6", "of order 1 in the camber")):
            self.assertRegex(keys[name][1], rf"^assumed: it was free, but the data do not determine it, {name} is {why}")

    def test_a_bound_and_a_missing_interval_are_told(self):
        bound = 'variable.PCY1 = {path = "PCY1", lower = 1.1, upper = 1.3, initial = 1.2}\n'
        folder = self.study("bound", self.tire(PCY1=1.2), more=bound)
        text = (folder / "study.toml").read_text()
        vary = text.index("measurement.cornering")
        (folder / "study.toml").write_text((text[:vary] + text[vary:]).replace("workers = 1", "workers = 1\nintervals = false"))
        self.latsch("run", folder / "study.toml")
        self.latsch("export", folder / "study.toml", "--model", folder / "fitted.tir")
        remark = keys_of((folder / "fitted.tir").read_text())["PCY1"][1]
        self.assertRegex(remark, r"^fitted 1\.3.*; at its bound 1\.3$")

    def test_before_a_run_nothing_is_called_fitted(self):
        folder = self.study("before", self.tire())
        self.latsch("export", folder / "study.toml", "--model", folder / "initial.tir")
        text = (folder / "initial.tir").read_text()
        self.assertIn("Not fitted: initial values", text)
        self.assertEqual(keys_of(text)["PDY1"][1], "assumed: initial value of the study, not fitted")
        self.assertNotIn("FZMAX", keys_of(text))

    def test_a_last_stage_that_names_its_experiments_tells_what_it_spoils(self):
        """The moment has an offset that only PHY1 can follow, at the cost of the side force of the first stage."""
        folder = self.base / "spoiled"
        folder.mkdir()
        lines = (self.base / "record.csv").read_text().splitlines()
        shifted = [line.rsplit(",", 1) for line in lines[1:]]
        (folder / "record.csv").write_text("\n".join([lines[0]] + [f"{left},{float(Mz) + 15.0!r}" for left, Mz in shifted]) + "\n")
        (folder / "tire.tir").write_text(self.tire(PHY1=0.0))
        variable = "".join(f'[variable.{name}]\npath = "{name}"\nlower = {low}\nupper = {high}\ninitial = {initial}\n'
                           for name, low, high, initial in (("PKY1", -60, -10, -25), ("PDY1", 0.3, 3, 1.1), ("PHY1", -0.05, 0.05, 0)))
        experiment = "".join(f'[experiment.{name}]\nkind = "curve"\ny = "t/{name}"\nmeasurement = "m"\nexponent = 2\n'
                             for name in ("Fy", "Mz"))
        (folder / "study.toml").write_text(
            'model = "tire.tir"\n[measurement.m]\nfile = "record.csv"\naxes = "iso"\n[test.t]\nkind = "steady_states"\n'
            'states = {from = "measurement.m"}\n' + variable + experiment +
            '[stage.Fy]\nfree = ["PKY1", "PDY1"]\nexperiments = ["Fy"]\n[stage.all]\nfree = ["PHY1"]\nexperiments = ["Mz"]\n')
        run = self.latsch("run", folder / "study.toml")
        self.assertRegex(run.stdout + run.stderr, r"Fy is worse than after an earlier stage")
        again = json.loads(self.latsch("run", folder / "study.toml", "--json").stdout)["result"]
        self.assertIn('"worse_than_own_stage": true', json.dumps(again))
        self.latsch("export", folder / "study.toml", "--model", folder / "o.tir")
        text = (folder / "o.tir").read_text()
        self.assertNotIn("No search of this study has ended", text)
        self.assertRegex(text, r"(?m)^PHY1\s+=.*\$ fitted")

    def test_the_date_alone_differs(self):
        folder = self.study("date", self.tire())
        self.latsch("run", folder / "study.toml")
        texts = []
        for k, date in enumerate(("1767225600", "1767225600", "1798761600")):
            self.latsch("export", folder / "study.toml", "--model", folder / f"{k}.tir", date=date)
            texts.append((folder / f"{k}.tir").read_text())
        self.assertEqual(texts[0], texts[1])
        self.assertEqual(texts[0], texts[2].replace("2027-01-01", "2026-01-01"))
        said = self.latsch("export", folder / "study.toml", "--model", folder / "x.tir", date="soon", code=WRONG_INPUT)
        self.assertIn("SOURCE_DATE_EPOCH", said.stderr)

    def test_what_new_holds_out_frees_nothing(self):
        """The record has three pressures, two of which are fitted. The fit has no quadratic term, and the third
        pressure is predicted."""
        columns = []
        for k, held in enumerate((["--hold-out", "p = 97 kPa +- 5 kPa"], [])):
            folder = self.base / f"new_{k}"
            self.latsch("new", folder, "--magic-formula", self.base / "record.csv", *held)
            text = (folder / "study.toml").read_text()
            vary = text[text.index("vary = "):].splitlines()[0]
            columns.append(("PPY4" in vary, "experiment.Fy_held" in text, "PDY2 = {path" in text))
        self.assertEqual(columns, [(False, True, True), (True, False, True)])
        self.latsch("check", self.base / "new_0" / "study.toml")
        tire = keys_of((self.base / "new_0" / "tire.tir").read_text())
        self.assertEqual(tire["PCY1"][1], "assumed by latsch new")
        self.assertIn("from the recordings", tire["FNOMIN"][1])

    def test_recordings_that_are_held_out(self):
        lines = (self.base / "record.csv").read_text().splitlines()
        for p, name in ((69, "a.csv"), (83, "b.csv"), (97, "c.csv")):
            (self.base / name).write_text("\n".join([lines[0]] + [x for x in lines[1:] if x.split(",")[4] == str(p)]) + "\n")
        names = [self.base / n for n in ("a.csv", "b.csv", "c.csv")]
        folder = self.base / "new_files"
        self.latsch("new", folder, "--magic-formula", *names, "--hold-out", self.base / "c.csv")
        text = (folder / "study.toml").read_text()
        self.assertNotIn('"PPY4"', text[text.index("vary = "):].splitlines()[0])
        self.assertRegex(text, r'measurement.cornering = \{files = \["../a.csv", "../b.csv"\]')
        self.assertRegex(text, r'measurement.cornering_held = \{file = "../c.csv"')
        for wrong, word in ((["--hold-out", "p = 97"], "window"), (["--hold-out", *names], "every recording"),
                            (["--hold-out", "q = 1 .. 2"], "no channel"), (["--hold-out", names[0], "p = 1 kPa .. 2 kPa"], "both")):
            said = self.latsch("new", self.base / "wrong", "--magic-formula", *names, *wrong, code=WRONG_INPUT)
            self.assertIn(word, said.stderr)

    def test_levels_are_those_of_the_stage_that_frees_a_coefficient(self):
        stages = ('stage.one = {free = ["PDY1", "PKY1"], experiments = ["Fy"]}\n'
                  'stage.two = {free = ["PPY3"], experiments = ["Fy_83"]}\nstage.all = {}\n')
        more = ('measurement.at_83 = {file = "record.csv", select = {p = "80 kPa .. 90 kPa"}}\n'
                'test.at_83 = {kind = "steady_states", states = {from = "measurement.at_83"}}\n'
                'experiment.Fy_83 = {kind = "curve", y = "at_83/Fy", measurement = "at_83", exponent = 2}\n')
        folder = self.study("stages", self.tire(), free=', "PPY3"', more=more + stages)
        said = self.latsch("check", folder / "study.toml").stderr
        self.assertRegex(said, r"variable PPY3 is free in stage two, but PPY3 is of order 1 in the pressure, of which there is 1")

    def test_check_says_of_what_its_warnings_are(self):
        folder = self.study("judged", self.tire(PDY2=0.4))
        self.assertRegex(self.latsch("check", folder / "study.toml").stderr, "the initial values, .*friction rises with load")
        self.latsch("run", folder / "study.toml")
        self.assertRegex(self.latsch("check", folder / "study.toml").stderr, "the best trial so far, .*friction rises with load")
        page = (folder / "study.html").read_text()
        self.assertRegex(page, r"Warning: beyond the data, .*friction rises with load")


if __name__ == "__main__":
    unittest.main()
