#!/usr/bin/env python3
"""Tests the program end to end on a coarse tire: new, export, check, simulate, doe, run, kill, resume, identify,
report.

   tire_study_test.py PATH/TO/latsch"""
import contextlib
import json
import pathlib
import re
import signal
import sqlite3
import subprocess
import time
import unittest

from cli_testing import FAILED, LATSCH, STOPPED, WRONG_INPUT, Coarse, edit, trials_of


class GoodInput(Coarse):
    def test_check_says_what_it_understood(self):
        self.assert_says(self.latsch("check", self.study), "sidewall", "8 N/mm^2", "HEX8", "load-deflection at 2.4 bar",
                         "2 values from stiffness.csv", "Everything is in order")

    def test_simulate_prints_forces_and_modes(self):
        text = self.latsch("simulate", self.study, "--set", "sidewall=6 N/mm^2")
        self.assert_says(text, "6 N/mm^2", "measured N", "measured Hz", "mean |dF|", "mean |df|", "target")

    def test_a_twin_is_perfect_at_the_values_it_was_written_with(self):
        text = self.latsch("simulate", self.study, "--set", "sidewall=5 N/mm^2")
        self.assertLess(float(re.search(r"target ([\d.]+) %", text)[1]), 0.001)

    def test_a_test_takes_number_of_modes_and_sensors_from_their_measurement(self):
        """Exports measurements that the model computes with the test of the experiment."""
        edit(self.study, ("# shapes = .*", 'shapes = "mode_shapes.csv"'))
        self.latsch("export", self.study, "--measurements")
        own = json.loads(self.latsch("simulate", self.study, "--json"))["result"]["experiments"][-1]
        (self.folder / "vibration.toml").write_text(
            'kind = "modes"\npressure = "2.4 bar"\ncount = {from = "measurement.frequencies"}\n'
            'points = {from = "measurement.shapes"}\n')
        edit(self.study, (r'(\[experiment\.modes\]\nkind = "modes")\npressure = .*', r'\1\ntest = "vibration"'),
             (r"\[experiment\.modes\]", """[measurement.frequencies]
file = "modes.csv"
[measurement.shapes]
file = "mode_shapes.csv"
[test.vibration]
file = "vibration.toml"
[experiment.modes]"""))
        named = json.loads(self.latsch("simulate", self.study, "--json"))["result"]["experiments"][-1]
        self.assertEqual(own, named)
        edit(self.folder / "vibration.toml", (r"points = .*\n", ""))
        self.assert_says(self.latsch("check", self.study, code=WRONG_INPUT),
                         "sensor points, but [test.vibration] records shapes at none")

    def test_run_ends_with_result_and_report(self):
        text = self.latsch("run", self.study)
        self.assert_says(text, "Best of", "target", "The search ended ", "sidewall", "Report: ")
        report = pathlib.Path(re.search(r"Report: (.*)", text)[1])
        ending = re.search(r"The search ended (.*)", text)[1]
        self.assertIn(ending, report.read_text())
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("resume", self.study, "--json"))
        self.assertEqual(answer["result"]["ending"], ending)
        claims = answer["result"]["claims"]
        self.assertTrue(ending.startswith(claims[0]["statement"]), claims)
        for claim in claims:
            for number in claim["numbers"]:
                self.assertLessEqual({"name", "value", "unit", "at_most", "at_least"}, set(number))
        self.assertIn("<html", report.read_text()[:500])
        self.assert_says(self.latsch("report", self.study), str(report))

    def test_a_coarse_mesh_comes_first_and_two_experiments_are_weighed_without_a_trial(self):
        edit(self.study, (r"\[optimizer\]", """[stage.coarse]
model.mesh.sectors = 12
step_tolerance = 0.05

[stage.fine]
bounds = 0.4

[optimizer]"""), (r"\[run\]", "[run]\nintervals = false"))
        text = self.latsch("run", self.study)
        self.assert_says(text, "Stage 1 of 2, coarse: mesh.sectors = 12", "Stage 2 of 2, fine", "Report")
        self.assertTrue((self.folder / "study.coarse.latsch").exists())
        trials = trials_of(self.folder / "study.latsch")
        edit(self.study, (r"(\[experiment\.stiffness\](?:.*\n)*?)weight = 1", r"\1weight = 5"))
        text = self.latsch("pareto", self.study, "stiffness", "modes")
        self.assert_says(text, "Nearest, though no search has looked for it, by the weights", "Pareto front", "stiffness %",
                         "nearest")
        self.assertIn("<svg", (self.folder / "study.pareto.html").read_text())
        self.assertEqual(trials_of(self.folder / "study.latsch"), trials)
        self.assert_says(self.latsch("report", self.study, code=WRONG_INPUT), "no search has run on the study as it stands")

    def test_killed_and_resumed_gives_the_same_result(self):
        whole = self.latsch("run", self.study)
        (self.folder / "study.latsch").unlink()
        with self.running_with_trials(3) as run:
            run.kill()
        resumed = self.latsch("resume", self.study)
        self.assert_says(resumed, "finished trials are reused")
        result = re.compile(r"Best of .*?\n\nReport", re.S)
        self.assertEqual(result.search(whole)[0], result.search(resumed)[0])

    def test_interrupted_says_how_to_go_on(self):
        edit(self.study, ("step_tolerance = .*", "step_tolerance = 1e-9"))
        with self.running_with_trials(3) as run:
            run.send_signal(signal.SIGINT)
            text, _ = run.communicate(timeout=30)
        self.assertEqual(run.returncode, STOPPED)
        self.assert_says(text, "Interrupted", "latsch resume")

    @contextlib.contextmanager
    def running_with_trials(self, finished):
        """Runs `latsch run` in the background; the body of the `with` begins once the journal holds the given number
        of trials."""
        journal = self.folder / "study.latsch"
        run = subprocess.Popen([LATSCH, "run", self.study], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            while trials_of(journal) < finished:
                self.assertIsNone(run.poll(), "the run ended before it was stopped")
                time.sleep(0.01)
            yield run
        finally:
            run.kill()
            run.communicate()

    def test_a_run_reuses_what_a_grid_evaluated(self):
        self.assert_says(self.latsch("doe", self.study, "--levels", "3"), "of 9 points succeeded", "Report: ")
        self.assert_says(self.latsch("run", self.study), "9 finished trials are reused")

    def test_a_fit_ends_with_intervals_and_identify_adds_verdicts_and_resumes(self):
        # The search ends at some distance from the minimum, so identify finds a better trial near its end and
        # continues from that one.
        text = self.latsch("run", self.study)
        self.assertRegex(text, r"carcass +[0-9.]+ GPa +95 %: .*GPa")
        trials = trials_of(self.folder / "study.latsch")
        text = self.latsch("identify", self.study, "--short")
        self.assert_says(text, "singular value", "Values and their confidence intervals, from 8 measured values")
        # the fit has already stored these trials in the journal
        self.assertEqual(trials_of(self.folder / "study.latsch"), trials)
        verdict = r"(sidewall|carcass) +(identifiable|one-sided|flat|several minima)"
        self.assertRegex(self.latsch("identify", self.study), verdict)
        self.assertIn("What the data determine", (self.folder / "study.html").read_text())
        trials = trials_of(self.folder / "study.latsch")
        self.assertRegex(self.latsch("identify", self.study, "--workers", "1"), verdict)
        self.assertEqual(trials_of(self.folder / "study.latsch"), trials)
        edit(self.study, ("timeout = .*", 'timeout = "10 min"\nintervals = false'))
        self.assertNotIn("95 %", self.latsch("run", self.study))

    def test_morris_prints_its_sensitivities_and_resumes(self):
        edit(self.study, (r'design = "full_factorial".*\nlevels = .*', 'design = "morris"\npoints = 6'))
        self.assert_says(self.latsch("doe", self.study), "Morris trajectories", "mu*", "sigma", "carcass")
        self.assert_says(self.latsch("doe", self.study), "Morris trajectories, 6 points; 6 finished trials")

    def test_doctor_finds_damage_and_saves_the_rest(self):
        self.latsch("doe", self.study, "--levels", "2")
        journal, saved = self.folder / "study.latsch", self.folder / "saved.latsch"
        self.assert_says(self.latsch("doctor", journal), "4 of 4 trials", "in order")
        self.assert_says(self.latsch("doctor", self.study), str(journal), "4 of 4 trials")
        with contextlib.closing(sqlite3.connect(journal)) as rows, rows:
            rows.execute("update trials set point = zeroblob(24) where number = 3")
        self.latsch("resume", self.study, code=FAILED)
        self.assert_says(self.latsch("doctor", journal, "--salvage", saved, code=FAILED), "3 of 4", "trials lost", ": 3\n")
        saved.replace(journal)
        self.assert_says(self.latsch("doe", self.study, "--levels", "2"), "3 finished trials")

    def test_a_failed_trial_ends_the_run_where_that_is_asked_for(self):
        # Pressing this tire's mesh on the ground never fails, so a time limit that is too short makes the trials
        # fail.
        edit(self.study, (r"\[run\]", '[run]\non_failure = "abort"'), ("timeout = .*", 'timeout = "1 ms"'))
        self.assert_says(self.latsch("run", self.study, code=FAILED), "Aborted", "0.001 s allowed", "It failed at")

    def test_export_writes_files_for_other_programs(self):
        tire, vtu, deck = (self.folder / name for name in ("identified.toml", "tire.vtu", "tire.inp"))
        self.latsch("export", self.study, "--model", tire, "--vtu", vtu, "--ccx", deck, "--deflection", "8 mm",
                    "--modes", "3")
        self.assert_says(self.latsch("mesh", tire), "HEX8", "kg")
        self.assertIn("VTKFile", vtu.read_text()[:200])
        self.assertIn("*NODE", deck.read_text().upper())

    def test_every_verb_has_help_with_an_example(self):
        for verb in ("new", "check", "mesh", "simulate", "doe", "run", "resume", "identify", "sample", "select", "design", "report", "pareto", "export",
                     "doctor", "process", "road", "test", "validate", "compare", "show"):
            self.assert_says(self.latsch(verb, "--help"), "xample", f"latsch {verb}")


if __name__ == "__main__":
    unittest.main()
