#!/usr/bin/env python3
"""Tests that a new model needs one file and one line: a program whose only model is a spring runs every verb of a
study, and serves as its own worker.

   spring_test.py PATH/TO/latsch     (the program "spring" is in the same folder)"""
import contextlib
import csv
import json
import pathlib
import re
import shutil
import sqlite3
import subprocess
import tempfile
import time
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, edit, trials_of

SPRING = pathlib.Path(LATSCH).with_name("spring")

STUDY = """
model = "spring.toml"
[test.fast]
file = "fast.toml"
[variable.stiffness]
path = "stiffness"
lower = "5 N/mm"
upper = "60 N/mm"
initial = "9 N/mm"
[variable.damping]
path = "damping"
lower = "50 N s/m"
upper = "900 N s/m"
initial = "700 N s/m"
[experiment.swiftly]
kind = "curve"
x = "fast/travel"
y = "fast/force"
measurement = "swiftly.csv"
[experiment.last]
kind = "values"
channel = "fast/force"
of = "last"
value = "300 N"
use = "predict"
[experiment.alone]
kind = "curve"
y = "fast/force"
measurement = "alone.csv"
use = "predict"
[experiment.each]
kind = "values"
channel = "fast/force"
values = ["160 N", "220 N", "300 N"]
use = "predict"
[doe]
design = "full_factorial"
levels = 3
[run]
workers = 2
"""


class SpringAlone(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_spring_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.study, self.model = self.folder / "study.toml", self.folder / "spring.toml"
        self.journal = self.folder / "study.latsch"
        self.model.write_text('kind = "spring"\nstiffness = "20 N/mm"\ndamping = "300 N s/m"\n')
        (self.folder / "fast.toml").write_text(
            'kind = "pull"\nspeed = "0.4 m/s"\nhold = "20 ms"\ntravels = ["2 mm", "5 mm", "9 mm"]\n')
        for table in ("swiftly.csv", "alone.csv"):
            (self.folder / table).write_text("travel [m],force [N]\n0.002,1\n0.005,1\n0.009,1\n")
        self.study.write_text(STUDY)

    def spring(self, *arguments, code=DONE):
        run = subprocess.run([SPRING, *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout if code == DONE else run.stderr

    def answer(self, *arguments):
        return json.loads(self.spring(*arguments, "--json"))["result"]

    def write_twin(self):
        self.spring("export", self.study, "--measurements")
        rows = (self.folder / "swiftly.csv").read_text().splitlines()
        force = [float(row.split(",")[1]) for row in rows if row[0].isdigit()]
        for found, x in zip(force, (0.002, 0.005, 0.009), strict=True):
            self.assertAlmostEqual(found, 20e3 * x + 300 * 0.4, places=6)

    def found(self):
        return {variable["name"]: variable["value"] for variable in self.answer("resume", self.study)["variables"]}

    def test_it_is_checked_fitted_identified_and_written(self):
        self.write_twin()
        for said in (r"spring\.toml: spring", "pulled at 0.4 m/s", "Everything is in order"):
            self.assertRegex(self.spring("check", self.study), said)
        truth = self.answer("simulate", self.study, "--set", "stiffness=20 N/mm", "--set", "damping=300 N s/m")
        self.assertEqual([e["name"] for e in truth["experiments"]], ["swiftly", "last", "alone", "each"])
        for experiment in truth["experiments"]:
            self.assertLess(experiment["largest_error"], 1e-9, experiment["name"])
        self.assertRegex(self.spring("run", self.study), r"stiffness +20.* N/mm +95 %: ")
        said = self.spring("identify", self.study)
        self.assertRegex(said, r"damping +identifiable")
        self.assertRegex(said, r"last +predicted +\+- .* N \(.* %\), last fast/force; 1 of 1 measured value inside")
        bands = {band["name"]: band for band in self.answer("identify", self.study)["bands"]}
        self.assertEqual(list(bands), ["swiftly", "last", "alone", "each"])
        for band in bands.values():
            for lower, computed, upper in zip(band["lower"], band["computed"], band["upper"], strict=True):
                self.assertLess(lower, computed)
                self.assertLess(computed, upper)
            self.assertEqual(band["inside"], len(band["measured"]))
        self.assertIn('class="band"', (self.folder / "study.html").read_text())
        self.assertIn("What the data determine", (self.folder / "study.html").read_text())
        self.assertIn("9 of 9 points succeeded", self.spring("doe", self.study))
        self.assertIn("Report: ", self.spring("report", self.study))
        written = self.folder / "found.toml"
        self.spring("export", self.study, "--model", written)
        forces = {c["name"]: c["values"] for c in self.answer("test", written, self.folder / "fast.toml")["channels"]}
        for force, x in zip(forces["force"], forces["travel"], strict=True):
            self.assertAlmostEqual(force, 20e3 * x + 120, delta=0.1)

    def test_samples_are_drawn_around_the_fit_and_again_alike(self):
        self.write_twin()
        self.spring("run", self.study)
        self.assertIn("state the noise", self.spring("sample", self.study, code=FAILED))
        edit(self.study, ('measurement = "swiftly.csv"', 'measurement = "swiftly.csv"\nnoise = "2 %"'))
        self.spring("run", self.study)
        found = self.answer("sample", self.study)
        self.assertEqual(found["check"]["verdict"], "stands")
        self.assertEqual(found["trials"], 22)
        for variable, value in zip(found["variables"], (20, 300), strict=True):
            # the model is linear: both intervals are that of a normal density, up to the scatter of 2000 samples
            self.assertEqual(variable["shape"], "as the linear interval")
            lower, upper = variable["linear"]
            self.assertAlmostEqual(0.5 * (lower + upper), value, delta=0.01 * value)
            for end, linear in zip(variable["interval"], variable["linear"], strict=True):
                self.assertAlmostEqual(end, linear, delta=0.25 * (upper - lower) / 3.92)
        samples = self.folder / "study.samples.csv"
        head, *rows = samples.read_text().splitlines()
        self.assertEqual(head, "stiffness [N/mm],damping [N s/m],log density,chain,density")
        self.assertEqual(len(rows), 2000)
        # bands of the computed forces: those of the samples are the linear ones, up to the same scatter
        bands = list(csv.DictReader((self.folder / "study.bands.csv").read_text().splitlines()))
        self.assertEqual({row["experiment"] for row in bands}, {"swiftly"}, "predicted ones have no residuals")
        for row in bands:
            self.assertEqual(row["density"], "surrogate")
            width = float(row["linear upper"]) - float(row["linear lower"])
            for end in ("lower", "upper"):
                self.assertAlmostEqual(float(row[end]), float(row["linear " + end]), delta=0.25 * width / 3.92)
        self.assertEqual([band["experiment"] for band in found["bands"]], ["swiftly"])
        [check] = found["predictive_checks"]
        # a twin without noise is nearer to the model than data with 2 % of it
        self.assertLess(check["chi_square"], 1.0)
        self.assertIn("0 points of a design succeeded, expected 30 at least", found["conflict_refused"])
        before, trials = samples.read_bytes(), trials_of(self.journal)
        said = self.spring("sample", self.study, "--workers", "1")
        self.assertRegex(said, r"swiftly +chi\^2 0\.[0-9]+ a value; .*\(rank of chi\^2 0\.[0-9]{3}\)")
        self.assertEqual(samples.read_bytes(), before)
        self.assertEqual(trials_of(self.journal), trials)

    def test_the_model_decides_on_samples_with_the_same_bits_for_any_number_of_workers(self):
        edit(self.folder / "fast.toml", ('hold = "20 ms"', 'hold = "0 ms"'))
        self.write_twin()
        edit(self.study, ('measurement = "swiftly.csv"', 'measurement = "swiftly.csv"\nnoise = "2 %"'))
        self.spring("run", self.study)
        fit = self.journal.read_bytes()
        samples = self.folder / "study.samples.csv"
        edit(self.study, (r"\[doe\]", '[posterior]\nmethod = "delayed"\nchain_runs = 4000\n[doe]'))
        written = []
        for workers in ("1", "2"):
            self.journal.write_bytes(fit)
            found = self.answer("sample", self.study, "--workers", workers)
            written.append(samples.read_bytes())
        self.assertEqual(*written)
        self.assertEqual((found["method"], found["mixed"]), ("delayed", True))
        self.assertLessEqual(found["chain_trials"], 4000)
        self.assertIn(",model", samples.read_text().splitlines()[1])
        for variable in found["variables"]:
            lower, upper = variable["linear"]
            for end, linear in zip(variable["interval"], variable["linear"], strict=True):
                self.assertAlmostEqual(end, linear, delta=0.4 * (upper - lower) / 3.92)
        again = self.spring("sample", self.study)
        self.assertIn("Delayed acceptance takes at most 4000 trials of the model", again)
        self.assertEqual(samples.read_bytes(), written[0], "read from the journal")
        edit(self.study, (r'method = "delayed"\n', ""))
        self.assertIn('is given for the method "surrogate"', self.spring("check", self.study, code=WRONG_INPUT))

    def test_a_run_may_draw_samples_at_its_end(self):
        self.write_twin()
        edit(self.study, ('measurement = "swiftly.csv"', 'measurement = "swiftly.csv"\nnoise = "2 %"'))
        found = self.answer("run", self.study, "--sample")
        self.assertEqual(found["posterior"]["check"]["verdict"], "stands")
        self.assertIn("target", found)
        self.assertTrue((self.folder / "study.samples.csv").exists())
        self.assertIn("samples", (self.folder / "study.html").read_text())
        edit(self.study, ('noise = "2 %"', 'noise = "2 %"\nloss = "huber"'))
        self.assertIn("--sample: experiment.swiftly has a robust loss", self.spring("run", self.study, "--sample", code=WRONG_INPUT))

    def test_values_that_no_point_of_a_design_reaches_are_told(self):
        self.write_twin()
        edit(self.study, ('measurement = "swiftly.csv"', 'measurement = "swiftly.csv"\nnoise = "2 %"'),
             ('upper = "60 N/mm"', 'upper = "12 N/mm"'), ('upper = "900 N s/m"', 'upper = "200 N s/m"'),
             ('initial = "700 N s/m"', 'initial = "100 N s/m"'))
        self.assertIn("9 points of a design succeeded, expected 30 at least", self.spring("doe", self.study))
        found = self.answer("doe", self.study, "--levels", "6")
        [row] = found["conflict"]
        self.assertEqual(row["beyond"], row["values"])
        self.assertEqual(row["has_to_be"], "larger")
        said = self.spring("doe", self.study, "--levels", "6")
        self.assertRegex(said, r"swiftly +[0-9]+ of [0-9]+ values beyond every point, .* by [0-9.]+ deviations; most moved by")

    def test_a_variable_that_the_data_do_not_carry_is_dropped(self):
        self.write_twin()
        edit(self.study, ('measurement = "swiftly.csv"', 'measurement = "swiftly.csv"\nnoise = "2 %"'))
        edit(self.study, (r"\[doe\]", '[selection]\nof = ["damp*"]\ntoward = {damping = "301 N s/m"}\n[doe]'))
        found = self.answer("select", self.study)
        # the data are those of 300 N s/m: 1 more changes forces by less than their noise
        [damping] = found["candidates"]
        self.assertEqual([damping["name"], damping["kept"], damping["value"]], ["damping", False, 301])
        self.assertLess(damping["rise"], 1.0)
        self.assertEqual([model["variables"] for model in found["path"]], [2, 1])
        self.assertLess(found["rivals"][0]["predicted_errors"]["last"], 0.01)
        chosen = self.folder / "study.selected.toml"
        self.assertIn('initial = "301 N s/m"', chosen.read_text())
        self.assertRegex(self.spring("run", chosen), r"stiffness +(19|20).* N/mm")
        table = (self.folder / "study.selection.csv").read_text()
        self.assertIn("damping,damping,N s/m,0,1,", table)
        # a damping of 400 N s/m is another model, which the data refuse
        edit(self.study, ("301 N s/m", "400 N s/m"))
        said = self.spring("select", self.study, "--workers", "1")
        self.assertRegex(said, r"damping +30[01] N s/m +26. .. 33. N s/m +29.[0-9] +kept")
        edit(self.study, (r"\[selection\]", "[selection]\nhonest = true"))
        self.assertIn("split it into several", self.spring("select", self.study, code=WRONG_INPUT))
        self.assertIn("not in the folder", self.spring("select", self.study, "-o", "/tmp/other.toml", code=WRONG_INPUT))

    def test_what_is_missed_is_told_with_what_would_mend_it(self):
        self.write_twin()
        edit(self.study, ('"220 N"', '"250 N"'))
        self.spring("run", self.study)
        [missed] = self.answer("identify", self.study)["missed"]
        # The spring's force is 20 N/mm 5 mm + 300 N s/m 0.4 m/s = 220 N; 30 N more of it need a damping that is
        # larger by a share of the 300 N of the fitted curve: a tenth.
        self.assertEqual([missed["value"], missed["fitted"], missed["variable"]],
                         ["each, fast/force, value 2", False, "damping"])
        self.assertAlmostEqual(missed["error"], 220 / 250 - 1, delta=1e-3)
        self.assertRegex(missed["payer"]["value"], "^swiftly, ")
        self.assertAlmostEqual(missed["payer"]["error"], 0.1, delta=1e-3)
        self.assertIn("each, fast/force, value 2 is 12.0 % too low", (self.folder / "study.html").read_text())

    def test_intervals_reach_to_the_numbers_of_the_refined_model(self):
        self.write_twin()
        # Pulled at 0.41 m/s instead of 0.4 m/s, the spring has the same forces with 0.4/0.41 of the damping, 2.5 %
        # less to first order.
        (self.folder / "fine.toml").write_text((self.folder / "fast.toml").read_text().replace("0.4 m/s", "0.41 m/s"))
        self.study.write_text(STUDY + '[refined.test.fast]\nfile = "fine.toml"\n')
        self.assertIn("tests fast", self.spring("check", self.study))
        stiffness, damping = self.answer("run", self.study)["variables"]
        self.assertAlmostEqual(stiffness["refined"], stiffness["value"], delta=1e-3)
        self.assertAlmostEqual(damping["refined"], 300 - 7.5, delta=0.05)
        self.assertLessEqual(damping["interval"][0], damping["refined"])
        said = self.spring("identify", self.study)
        self.assertRegex(said, r"damping +300.* N s/m +95 %: .*, mesh and step: -7.5")
        self.assertRegex(said, "more than the noise in damping")
        self.assertIn("Mesh and step", (self.folder / "study.html").read_text())
        self.study.write_text(STUDY + '[refined.test.fats]\nfile = "fine.toml"\n')
        self.assertIn('"fats", did you mean "fast"?', self.spring("check", self.study, code=WRONG_INPUT))

    def test_killed_on_two_workers_it_goes_on_without_repeating_a_trial(self):
        self.write_twin()
        self.spring("run", self.study)
        whole, trials = self.found(), trials_of(self.journal)
        self.journal.unlink()
        run = subprocess.Popen([SPRING, "run", self.study], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while trials_of(self.journal) < trials // 2:
            self.assertIsNone(run.poll(), "the run ended before it was killed")
            time.sleep(0.005)
        run.kill()
        run.wait()
        with contextlib.closing(sqlite3.connect(self.journal)) as rows:
            before = rows.execute("select number, point, finished from trials").fetchall()
        self.assertEqual(self.found(), whole)
        with contextlib.closing(sqlite3.connect(self.journal)) as rows:
            after = rows.execute("select number, point, finished from trials").fetchall()
        self.assertEqual(after[:len(before)], before)
        self.assertEqual(len(after), len({point for _, point, _ in after}), "trials repeated")

    def test_its_program_speaks_of_springs_alone(self):
        self.assertEqual(self.answer("test", "--list")["tests"],
                         [{"kind": "pull", "what": "is pulled", "models": ["spring"]}])
        page = self.spring("help", "study")
        self.assertRegex(page, r"\| `spring` \|.*\n(.*\n)*.*\| `pull` \| is pulled \|")
        for word in ("drum", "footprint", "magic_formula", "load_deflection"):
            self.assertNotRegex(re.sub(r"```(.|\n)*?```", "", page), rf"## .*{word}|\| `{word}` \|")
        self.assertNotRegex(self.spring("help").replace("my_tire", ""), "latsch new|Magic|tire|cleat")
        self.assertNotIn("ring_tire", self.spring("help", "test"))

    def test_a_test_of_another_language_is_refused_with_its_own(self):
        edit(self.folder / "fast.toml", ('"pull"', '"drum_cleat"'))
        self.assertRegex(self.spring("check", self.study, code=WRONG_INPUT), r'fast\.toml:1: .*"drum_cleat", expected "pull"')
        edit(self.model, ('"spring"', '"sprong"'))
        self.assertRegex(self.spring("check", self.study, code=WRONG_INPUT), r'spring\.toml:1: .*"sprong".*"spring"')


if __name__ == "__main__":
    unittest.main()
