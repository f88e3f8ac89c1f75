#!/usr/bin/env python3
"""Tests which trials of a journal count for a study. A best point that was found for other numbers is never used with
this model. A study in a folder without write permission can be read. Values that cannot be compared are no failure of
the model. Terminal, page and JSON count the trials for other measurements, weights or bounds alike, and call none of
them the best.

   identity_test.py PATH/TO/latsch     (the program "spring" is in the same folder)"""
import json
import os
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, edit, served, trials_of

SPRING = pathlib.Path(LATSCH).resolve().with_name("spring")

STUDY = """
model = "spring.toml"
[test.fast]
kind = "pull"
speed = "0.4 m/s"
travels = ["2 mm", "5 mm", "9 mm"]
[variable.stiffness]
path = "stiffness"
lower = "5 N/mm"
upper = "60 N/mm"
initial = "9 N/mm"
[experiment.each]
kind = "values"
channel = "fast/force"
values = ["160 N", "221 N", "300 N"]
[experiment.last]
kind = "values"
channel = "fast/force"
of = "last"
value = "301 N"
[run]
workers = 1
"""
SUITE = """
[test.fast]
kind = "pull"
speed = "0.4 m/s"
travels = ["2 mm"]
[check.first]
channel = "fast/force"
of = "first"
lower = "0 N"
source = "by hand"
"""
PULL = '{kind = "pull", speed = "0.1 m/s", travels = ["1 mm"]}'


class SpringStudy(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_identity_"))
        self.addCleanup(shutil.rmtree, self.folder)
        os.chmod(self.folder, 0o755)
        self.study, self.model = self.folder / "study.toml", self.folder / "spring.toml"
        self.journal = self.folder / "study.latsch"
        self.model.write_text('kind = "spring"\nstiffness = "20 N/mm"\ndamping = "300 N s/m"\n')
        self.study.write_text(STUDY)

    def run_it(self, *arguments, code=DONE, before=(), **options):
        run = subprocess.run([*before, SPRING, *arguments], capture_output=True, text=True, timeout=300, **options)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def found(self):
        run = subprocess.run([SPRING, "resume", self.study, "--json"], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, DONE, run.stderr)
        return json.loads(run.stdout)["result"]["variables"][0]["value"]


class OtherStudies(SpringStudy):
    def doors(self):
        """Checks every verb that uses the best point of a journal."""
        suite = self.folder / "suite.toml"
        suite.write_text(SUITE)
        return {"export": ("export", self.study, "--model", self.folder / "found.toml"),
                "test": ("test", self.study, PULL),
                "validate": ("validate", self.study, suite),
                "report": ("report", self.study),
                "pareto": ("pareto", self.study, "each", "last"),
                "identify": ("identify", self.study, "--short"),
                "run": ("run", self.study),
                "resume": ("resume", self.study)}

    def test_no_verb_combines_a_best_point_with_a_model_that_was_edited(self):
        self.run_it("run", self.study)
        for name, call in self.doors().items():
            with self.subTest(name):
                self.run_it(*call)
        edits = {"model": (self.model, '"300 N s/m"', '"310 N s/m"'),
                 "tests": (self.study, '"0.4 m/s"', '"0.5 m/s"'),
                 "variables": (self.study, r"variable.stiffness", "variable.spring")}
        for part, (file, was, now) in edits.items():
            text = file.read_text()
            edit(file, (was, now))
            for name, call in self.doors().items():
                with self.subTest(f"{name}, {part}"):
                    (self.folder / "found.toml").unlink(missing_ok=True)
                    said = self.run_it(*call, code=WRONG_INPUT)
                    for words in ("belongs to another study", f'"{part}" differs', "--anew"):
                        self.assertIn(words, said)
                    self.assertFalse((self.folder / "found.toml").exists())
            file.write_text(text)
        self.run_it("test", self.study, PULL)

    def test_what_differs_is_named_and_anew_begins_again(self):
        self.run_it("run", self.study)
        edit(self.study, ('"0.4 m/s"', '"0.5 m/s"'))
        said = self.run_it("test", self.study, PULL, code=WRONG_INPUT)
        self.assertIn('the journal has `fast.speed = "0.4 m/s"`, the study has `fast.speed = "0.5 m/s"`', said)
        self.run_it("run", self.study, "--anew")
        self.run_it("test", self.study, PULL)

    def test_a_test_that_moves_into_a_file_and_notes_keep_the_journal(self):
        self.run_it("run", self.study)
        trials = trials_of(self.journal)
        (self.folder / "fast.toml").write_text(
            '# a note\nkind = "pull"\ntravels = {unit = "m", values = [0.002, 0.005, 0.009]}   # the same\nspeed = "40 cm/s"\n')
        edit(self.study, (r'kind = "pull"\n.*\n.*\n', 'file = "fast.toml"\n'))
        edit(self.model, ('"20 N/mm"', '"20 kN/m"  # the same'))
        self.run_it("run", self.study)
        self.assertEqual(trials_of(self.journal), trials)


class NotCompared(SpringStudy):
    """Checks a study whose model is correct and whose faulty measurement is corrected after a run."""

    def test_a_failed_comparison_leaves_nothing_to_be_tried_again(self):
        self.run_it("run", self.study)
        right = self.folder / "right.latsch"
        self.journal.rename(right)
        edit(self.study, (r'"221 N", "300 N"\]', '"221 N"]'))
        said = self.run_it("run", self.study, code=FAILED)
        self.assertIn("has 3 values, expected 2 as measured", said)
        trials = trials_of(self.journal)
        self.assertGreater(trials, 0)
        self.assertIn(f"{trials} trials so far, {trials} of them without a target", self.run_it("check", self.study))
        edit(self.study, (r'"221 N"\]', '"221 N", "300 N"]'))
        self.assertIn(f"{trials} trials so far, 0 of them without a target", self.run_it("check", self.study))
        said = self.run_it("run", self.study)
        self.assertIn(f"{trials} finished trials are reused", said)
        best = self.found()
        shutil.copy(right, self.journal)
        self.assertEqual(self.found(), best)

    def test_check_counts_values_before_a_trial(self):
        tire = pathlib.Path(__file__).resolve().parents[4] / "studies/tire_model_comparison/magic_formula.tir"
        study = self.folder / "tire_study.toml"

        def said(channel, values):
            study.write_text(f"""
model = "{tire}"
[test.press]
kind = "static_stiffness"
deflections = ["10 mm", "20 mm"]
[test.stand]
kind = "static_stiffness"
load = "4 kN"
directions = ["vertical"]
[variable.stiffness]
path = "VERTICAL_STIFFNESS"
lower = "100 N/mm"
upper = "400 N/mm"
initial = "190 N/mm"
[experiment.one]
kind = "values"
channel = "{channel}"
{values}
""")
            run = subprocess.run([LATSCH, "check", study], capture_output=True, text=True, timeout=300)
            return run.returncode, run.stdout + run.stderr

        self.assertEqual(said("press/force", 'values = ["2 kN", "4 kN"]')[0], DONE)
        self.assertEqual(said("press/force", 'value = "4 kN"\nof = "last"')[0], DONE)
        code, words = said("press/force", 'value = "4 kN"')
        self.assertEqual(code, WRONG_INPUT)
        self.assertIn('the test "press" gives 2 values, but 1 is measured; of = "largest" takes one of several', words)
        code, words = said("press/force", 'values = ["2 kN", "4 kN", "6 kN"]')
        self.assertEqual(code, WRONG_INPUT)
        self.assertRegex(words, r'tire_study.toml:\d+: experiment.one.channel .* gives 2 values, but 3 are measured')
        self.assertEqual(said("stand/vertical", 'value = "200 N/mm"')[0], DONE)
        self.assertEqual(said("stand/vertical", 'values = ["200 N/mm", "210 N/mm"]')[0], WRONG_INPUT)


class ReadOnly(SpringStudy):
    """Checks a study in a read-only folder, such as an archive."""

    def setUp(self):
        super().setUp()
        self.own = pathlib.Path(tempfile.mkdtemp(prefix="latsch_reader_"))
        self.addCleanup(shutil.rmtree, self.own)
        self.reader = []
        if os.geteuid() == 0:  # root ignores permissions
            os.chmod(self.own, 0o777)
            if not shutil.which("setpriv"):
                self.skipTest("run by root, and setpriv is not here to be somebody else")
            self.reader = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"]
            if subprocess.run([*self.reader, SPRING, "--version"], capture_output=True, cwd="/").returncode != DONE:
                self.skipTest("run by root, and nobody else may run the program where it lies")

    def close(self):
        for file in self.folder.iterdir():
            os.chmod(file, 0o444)
        os.chmod(self.folder, 0o555)
        self.addCleanup(os.chmod, self.folder, 0o755)

    def read(self, *arguments, code=DONE):
        return self.run_it(*arguments, code=code, before=self.reader, cwd="/")

    def assert_readable(self):
        page, found, bands = self.own / "page.html", self.own / "found.toml", self.own / "bands.html"
        self.read("report", self.study, "-o", page)
        self.assertIn("<html", page.read_text())
        self.read("export", self.study, "--model", found)
        self.assertIn("stiffness", found.read_text())
        self.assertIn("force", self.read("test", self.study, PULL))
        said = self.read("identify", self.study, "-o", bands)
        self.assertRegex(said, r"stiffness +\d")
        self.assertIn("<html", bands.read_text())
        self.assertIn("No report is written", self.read("identify", self.study))
        self.assertIn("Every page and every hash is in order", self.read("doctor", self.journal))
        self.assertIn("Everything is in order", self.read("check", self.study))
        self.assertIn("-o FILE", self.read("report", self.study, code=WRONG_INPUT))
        self.assertIn("permission denied", self.read("run", self.study, code=WRONG_INPUT).lower())

    def test_it_is_reported_exported_tested_and_identified(self):
        self.run_it("run", self.study)
        self.run_it("identify", self.study)
        (self.folder / "study.html").unlink()
        self.close()
        self.assert_readable()

    def test_also_with_the_log_of_a_process_that_was_killed(self):
        self.run_it("run", self.study)
        self.run_it("identify", self.study)
        there = self.folder / "there.latsch"
        self.journal.rename(there)
        rows = sqlite3.connect(there)
        rows.execute("pragma journal_mode = wal").fetchone()
        rows.execute("pragma wal_autocheckpoint = 0")
        for change in (1, -1):  # an unchanged page is not written again
            rows.execute(f"update tally set trials = trials + {change}")
            rows.commit()
        shutil.copy(there, self.journal)
        shutil.copy(f"{there}-wal", f"{self.journal}-wal")
        self.assertGreater((self.folder / "study.latsch-wal").stat().st_size, 0)
        rows.close()
        there.unlink()
        (self.folder / "study.html").unlink()
        self.close()
        self.assert_readable()

    def test_what_would_need_trials_says_to_copy_it(self):
        with self.study.open("a") as study:
            study.write("intervals = false\n[optimizer]\nmax_steps = 1\n")
        self.run_it("run", self.study)
        self.assertEqual(trials_of(self.journal), 1)
        self.close()
        self.assertIn("copy the study to a folder of your own", self.read("identify", self.study, code=FAILED))

    def test_a_journal_that_may_not_be_read_is_not_called_damaged(self):
        self.run_it("run", self.study)
        os.chmod(self.journal, 0o000)
        self.addCleanup(os.chmod, self.journal, 0o644)
        said = self.read("doctor", self.journal, code=WRONG_INPUT)
        self.assertNotIn("damage:", said)
        self.assertRegex(said.lower(), "permission|may not be read")


TWO_MEASURED = """
model = "spring.toml"
[test.fast]
kind = "pull"
speed = "0.4 m/s"
travels = ["2 mm", "5 mm", "9 mm"]
[variable.stiffness]
path = "stiffness"
lower = "5 N/mm"
upper = "60 N/mm"
initial = "9 N/mm"
[variable.damping]
path = "damping"
lower = "10 N s/m"
upper = "900 N s/m"
initial = "100 N s/m"
[experiment.each]
kind = "values"
channel = "fast/force"
values = ["160 N", "221 N", "300 N"]
[experiment.curve]
kind = "curve"
x = "fast/travel"
y = "fast/force"
measurement = "pull.csv"
[doe]
levels = 3
[run]
workers = 1
"""
FOREIGN = "no search has run on the study as it stands"


class MeasuredSpring(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_foreign_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.study, self.data = self.folder / "study.toml", self.folder / "pull.csv"
        self.journal = self.folder / "study.latsch"
        (self.folder / "spring.toml").write_text('kind = "spring"\nstiffness = "20 N/mm"\ndamping = "300 N s/m"\n')
        self.data.write_text("travel [mm],force [N]\n3,180\n6,241\n8,282\n")
        self.study.write_text(TWO_MEASURED)
        (self.folder / "suite.toml").write_text(SUITE)

    def run_it(self, *arguments, code=DONE):
        run = subprocess.run([SPRING, *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def answer(self, *arguments, code=DONE):
        run = subprocess.run([SPRING, *arguments, "--json"], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return json.loads(run.stdout)

    def doors(self):
        """Returns the command line of every verb that uses the best point of a journal."""
        return {"export": ("export", self.study, "--model", self.folder / "found.toml"),
                "test": ("test", self.study, PULL),
                "validate": ("validate", self.study, self.folder / "suite.toml"),
                "report": ("report", self.study),
                "identify": ("identify", self.study, "--short")}

    def assert_refused(self, foreign):
        for name, call in self.doors().items():
            with self.subTest(name):
                (self.folder / "found.toml").unlink(missing_ok=True)
                (self.folder / "study.html").unlink(missing_ok=True)
                said = self.run_it(*call, code=WRONG_INPUT)
                self.assertIn(FOREIGN, said)
                self.assertIn(f"0 of them were run for the study as it stands, {foreign} for other", said)
                self.assertIn("latsch run", said)
                self.assertFalse((self.folder / "found.toml").exists() or (self.folder / "study.html").exists())

    def assert_open(self, without=()):
        for name, call in self.doors().items():
            if name in without:
                continue
            with self.subTest(name):
                self.run_it(*call)


class OtherData(MeasuredSpring):
    edits = {"measurement file": ("data", "6,241", "6,250"),
             "values in the study": ("study", '"221 N"', '"231 N"'),
             "weight": ("study", r"\[experiment.curve\]", "[experiment.curve]\nweight = 3"),
             "held out": ("study", r"\[experiment.curve\]", '[experiment.curve]\nuse = "predict"'),
             "bounds": ("study", '"60 N/mm"', '"19 N/mm"'),
             "exponent": ("study", r"\[experiment.each\]", "[experiment.each]\nexponent = 2")}

    def test_a_best_point_of_other_data_weights_or_bounds_is_refused_until_a_search_has_run(self):
        self.run_it("run", self.study)
        self.assert_open()
        first = self.journal.read_bytes()
        for what, (attribute, was, now) in self.edits.items():
            file = getattr(self, attribute)
            text = file.read_text()
            self.journal.write_bytes(first)
            trials = trials_of(self.journal)
            edit(file, (was, now))
            with self.subTest(what):
                self.assert_refused(trials)
                said = self.run_it("check", self.study)
                self.assertIn(FOREIGN, said)
                self.assertNotIn("Everything is in order", said)
                counts = self.answer("check", self.study)["result"]
                self.assertEqual((counts["trials"], counts["foreign"]), (trials, trials))
                said = self.run_it("run", self.study)
                self.assertIn(f"{trials} finished trials are reused", said)
                self.assertIn("simulated earlier, for other measurements", said)
                self.assertNotIn("of them were run for the study as it stands", said)
                # Three values on a line fit exactly; the other values are held out.
                self.assert_open(without=("identify",) if what == "held out" else ())
                self.assertNotIn(FOREIGN, self.run_it("check", self.study))
                stiffness = float(re.search(r"stiffness = \"?([0-9.]+)", (self.folder / "found.toml").read_text()).group(1))
                if what == "bounds":  # better trials outside the new bounds are in the journal
                    self.assertLessEqual(stiffness, 19.0)
            file.write_text(text)

    def test_a_front_of_foreign_trials_is_drawn_and_its_least_target_not_called_the_best(self):
        self.run_it("run", self.study)
        call = ("pareto", self.study, "each", "curve")
        self.assertIn("Best by the weights of the study", self.run_it(*call))
        self.assertIn("target", self.answer(*call)["result"])
        edit(self.study, (r"\[experiment.curve\]", "[experiment.curve]\nweight = 3"))
        said, page = self.run_it(*call), self.folder / "study.pareto.html"
        for text in (said, page.read_text()):
            self.assertIn(FOREIGN, text)
            self.assertNotIn("est by the weights", text.replace("nearest by", "").replace("nearest one by", ""))
        answer = self.answer(*call)["result"]
        self.assertNotIn("target", answer)
        self.assertIn("target", answer["nearest"])
        self.run_it("run", self.study)
        self.assertIn("Best by the weights of the study", self.run_it(*call))

    def test_what_changes_no_target_keeps_the_best_point(self):
        self.run_it("run", self.study)
        edit(self.study, ("workers = 1", "workers = 2"), (r"levels = 3", "levels = 4"), (r'model = ', 'title = "Another name"  # note\nmodel = '))
        with self.study.open("a") as study:
            study.write("[optimizer]\nmax_steps = 77\n")
        self.assert_open()
        self.assertIn("Everything is in order", self.run_it("check", self.study))

    def test_back_to_the_old_data_the_old_best_point_is_back(self):
        self.run_it("run", self.study)
        found = self.folder / "found.toml"
        self.run_it("export", self.study, "--model", found)
        before = re.search("stiffness = .*", found.read_text()).group()
        edit(self.data, ("6,241", "6,250"))
        self.run_it("export", self.study, "--model", found, code=WRONG_INPUT)
        edit(self.data, ("6,250", "6,241"))
        self.run_it("export", self.study, "--model", found)
        self.assertEqual(re.search("stiffness = .*", found.read_text()).group(), before)

    def test_a_design_on_edited_data_speaks_of_its_own_points_alone(self):
        self.run_it("run", self.study)
        self.run_it("doe", self.study)
        edit(self.data, ("6,241", "6,250"))
        self.assert_refused(trials_of(self.journal))
        said = self.run_it("doe", self.study)  # all points of the design are already in the journal
        self.assertIn("9 of 9 points succeeded", said)
        best = self.answer("doe", self.study)["result"]
        self.assertEqual(best["target"], best["points"][0]["target"])
        self.assertEqual(best["trials"] - best["foreign"], 9)

    def test_a_start_from_a_foreign_journal_that_was_interrupted_has_no_best_point(self):
        self.run_it("run", self.study)
        other = self.folder / "other"
        other.mkdir()
        for name in ("spring.toml", "pull.csv"):
            shutil.copy(self.folder / name, other)
        edit(other / "pull.csv", ("6,241", "6,250"))
        (other / "study.toml").write_text(TWO_MEASURED + '[optimizer]\nstart = "journal"\nstart_journal = "../study.latsch"\n')
        self.run_it("run", other / "study.toml")
        rows = sqlite3.connect(other / "study.latsch")
        kinds = [kind for kind, in rows.execute("select kind from marks order by number")]
        texts = [text for text, in rows.execute("select text from marks where kind = 'target' order by number")]
        rows.close()
        self.assertIn("ended", kinds)
        self.assertIn("taken over", texts)
        self.assertEqual(texts[-1], texts[0])


class Counts(MeasuredSpring):
    """Tests the counts of trials that the terminal, the JSON answers and the page show."""

    def page(self):
        """Returns what the page says about the study, and what its list of studies says."""
        with served(self.folder, program=str(SPRING)) as page:
            home = page.get("/api/home")["studies"]
            return page.get("/api/study?study=study.toml"), next(one for one in home if one["study"] == "study.toml")

    def assert_alike(self, ran=None):
        view, row = self.page()
        checked = self.answer("check", self.study)["result"]
        for key in ("trials", "succeeded", "failed", "foreign"):
            self.assertEqual(view[key], checked[key], key)
            if ran:
                self.assertEqual(ran[key], checked[key], key)
        self.assertEqual((row["trials"], row["foreign"]), (checked["trials"], checked["foreign"]))
        self.assertEqual(checked["trials"], trials_of(self.journal))
        said = self.run_it("check", self.study)
        if checked["failed"] is not None:
            self.assertIn(f"{checked['trials']} trials so far, {checked['failed']} of them without a target", said)
        return checked, view

    def test_after_a_run_and_after_an_edit(self):
        ran = self.answer("run", self.study)["result"]
        checked, view = self.assert_alike(ran)
        self.assertEqual(checked["foreign"], 0)
        self.assertIsNotNone(view["best"])
        edit(self.data, ("6,241", "6,250"))
        checked, view = self.assert_alike()
        self.assertEqual(checked["foreign"], checked["trials"])
        self.assertIsNone(view["best"])
        self.assertTrue(any(FOREIGN in words for words in view["warnings"]))
        ran = self.answer("run", self.study)["result"]
        checked, view = self.assert_alike(ran)
        self.assertTrue(0 < checked["foreign"] < checked["trials"])
        self.assertIsNotNone(view["best"])

    def test_with_trials_without_a_target(self):
        self.run_it("run", self.study)
        edit(self.study, ('"221 N", "300 N"]', '"221 N"]'))
        checked, _ = self.assert_alike()
        self.assertEqual(checked["failed"], checked["trials"])

    def test_of_an_edited_test(self):
        self.run_it("run", self.study)
        edit(self.study, ('"0.4 m/s"', '"0.5 m/s"'))
        checked, view = self.assert_alike()
        self.assertEqual((checked["foreign"], checked["succeeded"]), (checked["trials"], None))
        self.assertIsNone(view["best"])
        said = self.run_it("check", self.study)
        self.assertIn(f"None of its {checked['trials']} trials are of the study as it stands", said)
        self.assertIn("--anew", said)
        self.assertNotIn("Everything is in order", said)


if __name__ == "__main__":
    unittest.main()
