#!/usr/bin/env python3
"""Tests a run during which somebody edits its files, deletes its journal or starts it again.

   running_studies_test.py PATH/TO/latsch"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, Coarse, edit, trials_of

STUDIES = pathlib.Path(__file__).resolve().parents[4] / "studies"
TIR = STUDIES / "tire_model_comparison" / "rigid_ring.tir"
BUILT_IN = """model = "base.tir"
[test.pressed]
kind = "load_deflection"
deflections = ["5 mm", "10 mm", "20 mm", "32 mm"]
[variable.k]
path = "VERTICAL_STIFFNESS"
lower = "150 N/mm"
upper = "250 N/mm"
initial = "180 N/mm"
[variable.q]
path = "Q_FZ2"
lower = 0
upper = 100
initial = 20
[experiment.c]
kind = "curve"
x = "pressed/deflection"
y = "pressed/force"
measurement = "m.csv"
exponent = 2
[optimizer]
method = "auto"
"""
MEASURED = "deflection [mm],force [N]\n10,1800\n20,4000\n30,6600\n"

# A trial takes some tenths of a second, and the search takes dozens of them.
SLOW = """[model]
kind = "rigid_ring"
file = "base.tir"
[test.rig]
kind = "drum_cleat"
speed = "30 km/h"
load = "3.5 kN"
drum_diameter = "2.5 m"
run_in = "0.1 s"
duration = "0.12 s"
lead = "0.02 s"
step = "0.5 ms"
sample_step = "2 ms"
cleat = {height = "10 mm", length = "20 mm"}
[variable.k]
path = "VERTICAL_STIFFNESS"
lower = "150 N/mm"
upper = "250 N/mm"
initial = "180 N/mm"
[variable.q]
path = "LONGITUDINAL_STIFFNESS"
lower = "100 N/mm"
upper = "300 N/mm"
initial = "180 N/mm"
[experiment.c]
kind = "curve"
x = "rig/time"
y = "rig/Fz"
measurement = "m.csv"
[optimizer]
method = "gss"
max_steps = 14
[run]
intervals = false
"""
SLOW_MEASURED = "time [s],Fz [N]\n" + "".join(
    f"{0.01 * k},{3500 + 900 * (k in (4, 5)) - 500 * (k == 6)}\n" for k in range(-1, 10))


def numbers(text):
    """Returns the printed result without the lines that say how it was reached."""
    return [line for line in text.splitlines() if re.search(r"95 %|Best of|  fitted|Journal:", line)]


def children(parent):
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text()
        except OSError:  # the process has just ended
            continue
        if int(text.rpartition(")")[2].split()[1]) == parent:
            found.append(int(stat.parent.name))
    return found


class Small(unittest.TestCase):
    """Tests with a study of some dozens of trials of a millisecond each."""

    assert_says = Coarse.assert_says

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_running_"))
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copy(TIR, self.folder / "base.tir")
        (self.folder / "m.csv").write_text(MEASURED)
        (self.folder / "study.toml").write_text(BUILT_IN)
        self.study = self.folder / "study.toml"
        self.journal = self.folder / "study.latsch"

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300, cwd=self.folder)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr


class FinishedStudies(Small):
    def assert_repeats(self, verb="run"):
        first = self.latsch("run", "study.toml")
        size = trials_of(self.journal)
        for _ in range(2):
            again = self.latsch(verb, "study.toml")
            self.assertIn("This study is finished", again)
            self.assertEqual(numbers(again), numbers(first))
            self.assertEqual(trials_of(self.journal), size)
        self.assertNotIn("This study is finished", first)

    def test_a_search_that_ended_at_a_minimum_is_repeated(self):
        self.assert_repeats()

    def test_resume_of_a_finished_study_repeats_it_too(self):
        self.assert_repeats("resume")

    def test_a_search_that_ended_by_its_budget_is_repeated(self):
        """Checks a study whose intervals would move to a better trial each time they are computed."""
        edit(self.study, ('method = "auto"', 'method = "auto"\nmax_steps = 6'))
        self.assert_repeats()

    def test_a_raised_budget_an_edit_and_anew_go_on(self):
        edit(self.study, ('method = "auto"', 'method = "auto"\nmax_steps = 6'))
        self.latsch("run", "study.toml")
        size = trials_of(self.journal)
        edit(self.study, ("max_steps = 6", "max_steps = 60"))
        self.assertNotIn("is finished", self.latsch("run", "study.toml"))
        self.assertGreater(trials_of(self.journal), size)
        self.assertIn("is finished", self.latsch("run", "study.toml"))
        edit(self.study, ("upper = 100", "upper = 90"))
        self.assertNotIn("is finished", self.latsch("run", "study.toml"))
        self.assertNotIn("is finished", self.latsch("run", "study.toml", "--anew"))
        edit(self.folder / "m.csv", ("1800", "1801"))
        self.assertNotIn("is finished", self.latsch("run", "study.toml"))

    def test_trials_of_another_command_end_the_repetition(self):
        self.latsch("run", "study.toml")
        self.latsch("doe", "study.toml", "--levels", "3")
        self.assertNotIn("is finished", self.latsch("run", "study.toml"))
        self.assertIn("is finished", self.latsch("run", "study.toml"))

    def test_a_program_is_told(self):
        for expected in (False, True):
            run = subprocess.run([LATSCH, "run", "study.toml", "--json"], capture_output=True, text=True, cwd=self.folder)
            found = json.loads(run.stdout)["result"]
            self.assertEqual(found["repeated"], expected)
        self.assertIn("not searched again", self.latsch("run", "--help"))


class RunningStudies(Small):
    """Tests what happens if a user changes the files of a run that already has some trials."""

    def setUp(self):
        super().setUp()
        self.study.write_text(SLOW)
        (self.folder / "m.csv").write_text(SLOW_MEASURED)
        self.process = None

    def tearDown(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.communicate()

    def start(self):
        self.process = subprocess.Popen([LATSCH, "run", "study.toml"], cwd=self.folder, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        end = time.monotonic() + 120
        while trials_of(self.journal) < 2 and self.process.poll() is None and time.monotonic() < end:
            time.sleep(0.01)

    def end(self, code):
        self.assertIsNone(self.process.poll(), "the run has ended before the test did anything")
        said = self.process.communicate(timeout=280)[0]
        self.assertEqual(self.process.returncode, code, said)
        return said

    def assert_own_report(self, part):
        page = (self.folder / "study.html").read_text()
        self.assert_says(page, "have changed while this run went on", part)
        self.assertNotIn("belongs to another study", page)
        self.assertIn("<svg", page)  # the run's own curves

    def test_an_edited_model_is_told_and_the_report_is_that_of_the_run(self):
        self.start()
        edit(self.folder / "base.tir", (r"UNLOADED_RADIUS *= *[0-9.]+", "UNLOADED_RADIUS = 0.33"))
        said = self.end(FAILED)
        self.assert_says(said, "Best of", "have changed while this run went on", '"model" differs', "Report: ")
        self.assert_own_report("UNLOADED_RADIUS")

    def test_an_edited_measurement_is_told(self):
        self.start()
        edit(self.folder / "m.csv", ("4400", "4410"))
        self.assert_says(self.end(FAILED), "have changed while this run went on", "measurements")

    def test_edited_bounds_are_told_and_a_comment_changes_nothing(self):
        self.start()
        edit(self.study, ('upper = "250 N/mm"', 'upper = "240 N/mm"'))
        self.assert_says(self.end(FAILED), "have changed while this run went on")
        self.journal.unlink()
        self.start()
        self.study.write_text("# A comment.\n" + self.study.read_text())
        self.assertNotIn("have changed", self.end(DONE))

    def test_a_worker_that_starts_later_refuses_an_edited_model(self):
        """A trial of the edited model in the journal of the old model would be wrong, and nothing would show it."""
        self.start()
        edit(self.folder / "base.tir", (r"UNLOADED_RADIUS *= *[0-9.]+", "UNLOADED_RADIUS = 0.33"))
        workers = children(self.process.pid)
        self.assertTrue(workers)
        for pid in workers:
            os.kill(pid, 9)
        self.assert_says(self.end(WRONG_INPUT), "have changed since the run began", "latsch resume")
        self.assertGreaterEqual(trials_of(self.journal), 2)

    def test_a_hard_link_is_in_use_too(self):
        self.start()
        os.link(self.journal, self.folder / "hard.latsch")
        (self.folder / "hard.toml").write_text(SLOW + 'journal = "hard.latsch"\n')
        said = self.latsch("run", "hard.toml", code=WRONG_INPUT)
        self.assert_says(said, f"in use by process {self.process.pid}", "hard link")
        self.end(DONE)

    def test_a_deleted_journal_is_told_and_its_trials_are_saved(self):
        self.start()
        self.journal.unlink()
        said = self.end(FAILED)
        self.assert_says(said, "was deleted while it was written", "saved under its name again")
        saved = trials_of(self.journal)
        self.assertGreaterEqual(saved, 3)
        self.assertIn(f"{saved} finished trials are reused", self.latsch("resume", "study.toml"))

    def test_a_replaced_journal_is_told_and_its_trials_are_saved_beside_it(self):
        self.start()
        (self.folder / "other").write_text("somebody else's file")
        os.replace(self.folder / "other", self.journal)
        self.assert_says(self.end(FAILED), "was replaced by another file", "study.saved.latsch")
        self.assertGreaterEqual(trials_of(self.folder / "study.saved.latsch"), 3)
        self.assertEqual(self.journal.read_text(), "somebody else's file")

    def test_a_journal_that_is_moved_is_told(self):
        self.start()
        self.journal.rename(self.folder / "moved.latsch")
        self.assert_says(self.end(FAILED), "was moved to", "moved.latsch")
        self.assertGreaterEqual(trials_of(self.folder / "moved.latsch"), 3)


if __name__ == "__main__":
    unittest.main()
