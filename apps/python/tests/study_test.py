#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests studies from Python: their contents, runs by the program, journals as arrays, and an interrupted run that
continues."""
import contextlib
import os
import pathlib
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest
import warnings

os.environ.setdefault("LATSCH_PROGRAM", sys.argv[1] if len(sys.argv) > 1 else "latsch")

import latsch  # noqa: E402
import numpy as np  # noqa: E402
from python_testing import LATSCH, ROOT  # noqa: E402

LONG = '[optimizer]\nmethod = "genetic"\npopulation = 40\ngenerations = 15\nstep_tolerance = 1e-9\n[run]\nintervals = false\n'


# Source text of an external program that fails for a > 0.6.
PROGRAM = """
import sys
a = float(open("a.txt").read().split("=")[1])
if a > 0.6:
    sys.exit("too much: %g" % a)
open("out.csv", "w").write("y [N]\\n%r\\n" % (a - 0.55))
"""
STUDY_OF_A_PROGRAM = """
[simulator]
command = ["python3", "program.py"]
inputs = ["a.txt"]
files = ["program.py"]
[simulator.output.out]
file = "out.csv"
reader = "table"
quantities = ["y [N]"]
[variable.a]
lower = 0
upper = 1
initial = 0.5
[experiment.e]
kind = "values"
channel = "out/y"
value = "0.1 N"
[doe]
design = "full_factorial"
levels = 9
"""


class Studies(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_python_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def compliance(self, name="compliance", tail=""):
        folder = self.folder / name
        shutil.copytree(ROOT / "studies/compliance", folder, ignore=shutil.ignore_patterns("*.latsch*", "*.html"))
        file = folder / "study.toml"
        text = file.read_text()
        if tail:
            text = text.split("[optimizer]")[0].split("[run]")[0] + tail
        file.write_text(text)
        return latsch.read_study(file)

    def of_a_program(self):
        folder = self.folder / "program"
        folder.mkdir()
        (folder / "program.py").write_text(PROGRAM)
        (folder / "a.txt").write_text("a = {a}\n")
        (folder / "study.toml").write_text(STUDY_OF_A_PROGRAM.replace("0.1 N", "-0.1 N"))
        return folder / "study.toml"

    def test_a_best_point_of_other_data_is_none(self):
        file = self.of_a_program()
        latsch.read_study(file).run(workers=1, progress=False)
        study = latsch.read_study(file)
        found = study.best()
        self.assertAlmostEqual(found.point[0], 0.45, delta=1e-3)
        self.assertTrue(study.trials().own.all())
        text = file.read_text()
        for was, now in (('"-0.1 N"', '"-0.2 N"'), ("lower = 0", "lower = 0.46"),
                         ('channel = "out/y"', 'channel = "out/y"\nexponent = 2')):
            with self.subTest(now):
                file.write_text(text.replace(was, now))
                edited = latsch.read_study(file)
                with self.assertRaisesRegex(latsch.InputError, "no search has run on the study as it stands.*latsch run"):
                    edited.best()
                self.assertEqual(len(edited.trials()), len(study.trials()))
                self.assertFalse(edited.trials().own.any())
        file.write_text(text.replace('"-0.1 N"', '"-0.2 N"'))
        edited = latsch.read_study(file)
        edited.run(workers=1, progress=False)
        self.assertAlmostEqual(edited.best().point[0], 0.35, delta=1e-3)
        self.assertTrue(edited.trials().own.any())
        self.assertFalse(edited.trials().own.all())

    def test_every_door_refuses_the_journal_of_another_study(self):
        """Checks that studies in Python notice an edited program, another path and another test, as the verbs of the
        program do."""
        study = self.compliance()
        study.run(workers=1, progress=False)
        file = pathlib.Path(study.file)
        self.assertIsNotNone(latsch.read_study(file).best())
        self.assertIn("Fitted and exported", latsch.read_study(file).fitted_text("2026-01-01"))
        model = file.parent / "corner.toml"
        text = model.read_text()
        model.write_text(text.replace("1648.347 mm", "1649.347 mm"))
        edited = latsch.read_study(file)
        for door in (edited.best, edited.trials, edited.fitted_text):
            with self.subTest(door.__name__), self.assertRaisesRegex(latsch.InputError, "belongs to another study"):
                door()
        with self.assertRaisesRegex(latsch.InputError, "belongs to another study"):
            edited.identify(workers=1, progress=False)
        model.write_text(text)
        self.assertIsNotNone(latsch.read_study(file).best())

    def test_a_study_says_what_it_varies_and_compares(self):
        study = self.compliance()
        self.assertEqual(study.space.names[:2], ["uca_front", "uca_rear"])
        self.assertEqual(study.variables[0].paths[0], "bushing.uca_front.x")
        self.assertEqual(study.space.upper[0], 4e8)
        first = study.experiments[0]
        self.assertEqual((first.name, first.kind, first.fitted), ("A_dz", "values", True))
        self.assertEqual(first.channels, ["A/dz_by_Fz"])
        np.testing.assert_allclose(first.measured, [0.24329e-6], rtol=1e-12)  # m/N
        self.assertEqual(study.model(study.space.initial)["bushing.uca_front.x"], study.space.initial[0])

    def test_a_point_outside_of_the_bounds_is_told(self):
        study = self.compliance()
        point = study.space.initial.copy()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            study.model(point)
        point[0] = 2 * study.space.upper[0]
        for door in (study.score, study.simulate, study.model, lambda at: study.target(at, study.simulate(study.space.initial))):
            with self.subTest(door), self.assertWarnsRegex(UserWarning, "variable uca_front is .* outside of its bounds"):
                door(point)
        point[0] = float("nan")
        with self.assertRaisesRegex(latsch.InputError, "uca_front is nan, expected a finite number"):
            study.score(point)

    def test_a_run_its_journal_and_its_target(self):
        study = self.compliance()
        lines = []
        result = study.run(workers=1, progress=lines.append)
        self.assertTrue(any("done" in line for line in lines))
        trials = study.trials(channels=True)
        with contextlib.closing(sqlite3.connect(study.journal)) as rows:
            self.assertEqual(len(trials), rows.execute("select count(*) from trials").fetchone()[0])
        best = study.best()
        self.assertEqual(best.target, result["target"])
        row = int(np.nanargmin(trials.targets))
        np.testing.assert_array_equal(trials.points[row], best.point)
        self.assertEqual(trials.failures, [None] * len(trials))
        self.assertTrue(trials.asked.all())
        # A trial in this process has the same bits as in the journal, and its channels have the same objective.
        recording = study.simulate(best.point)
        channels = {name: column[row] for name, column in trials.channels.items()}
        for name, values in channels.items():
            np.testing.assert_array_equal(values, recording[name], err_msg=name)
        self.assertEqual(study.target(best.point, channels).value, best.target)
        self.assertEqual(trials.units["A/dz_by_Fz"], recording.units["A/dz_by_Fz"])
        self.assertEqual(study.trials().channels, {})
        self.assertEqual(len(result["variables"]), len(study.variables))

    def test_a_recording_notes_the_ranges_that_the_tire_leaves(self):
        text = (ROOT / "studies/tire_model_comparison/rigid_ring.tir").read_text()
        (self.folder / "t.tir").write_text(text.replace("[DIMENSION]", "FZMAX = 3000\n[DIMENSION]", 1))
        (self.folder / "study.toml").write_text(textwrap.dedent("""
            model = "t.tir"
            [test.rolled]
            kind = "rolling_stiffness"
            load = "4 kN"
            measures = ["slip"]
            [variable.k]
            path = "PKX1"
            lower = 10
            upper = 25
            initial = 14
            [experiment.slip]
            kind = "values"
            channel = "rolled/slip_stiffness"
            value = "60000 N"
            """))
        study = latsch.read_study(self.folder / "study.toml")
        notes = study.simulate([14.0]).notes
        self.assertEqual(len(notes), 1, notes)
        self.assertIn("test rolled: Fz is 4000 N in this test, above FZMAX = 3000 N", notes[0])

    def test_the_file_of_the_fitted_model_is_that_of_the_program(self):
        study = self.compliance("fitted_text")
        file = pathlib.Path(study.file)
        self.assertIn("Not fitted: initial values", study.fitted_text("2026-01-01"))
        study.run(1, progress=False)
        exported = file.parent / "exported.toml"
        subprocess.run([LATSCH, "export", str(file), "--model", str(exported), "--quiet"], check=True,
                       env={**os.environ, "SOURCE_DATE_EPOCH": "1767225600"})
        self.assertEqual(study.fitted_text("2026-01-01"), exported.read_text())
        self.assertRegex(exported.read_text(), r"# Target: ")

    def test_slopes_of_a_score_are_the_limits_of_differences(self):
        study = self.compliance()
        x = study.space.initial
        score = study.score(x)
        self.assertEqual(score.jacobian.shape, (len(score.residuals), len(x)))
        self.assertAlmostEqual(score.value, score.residuals @ score.residuals, delta=1e-12 * score.value)
        h = 1e-4 * x[0]
        moved = [study.score(x + sign * h * np.eye(len(x))[0], slopes=False) for sign in (1, -1)]
        self.assertIsNone(moved[0].jacobian)
        difference = (moved[0].residuals - moved[1].residuals) / (2 * h)
        np.testing.assert_allclose(score.jacobian[:, 0], difference, rtol=1e-5, atol=1e-7 * abs(difference).max())

    def test_failures_stand_in_the_journal_with_their_reason(self):
        (self.folder / "program.py").write_text(PROGRAM)
        (self.folder / "a.txt").write_text("a = {a}\n")
        (self.folder / "study.toml").write_text(STUDY_OF_A_PROGRAM)
        study = latsch.read_study(self.folder / "study.toml")
        study.doe(progress=False)
        trials = study.trials(channels="out/y")
        failed = np.array([one is not None for one in trials.failures])
        np.testing.assert_array_equal(failed, trials.points[:, 0] > 0.6)
        np.testing.assert_array_equal(np.isnan(trials.targets), failed)
        reasons = [one for one in trials.failures if one]
        self.assertIsInstance(reasons[0], latsch.Failure)
        self.assertEqual(reasons[0].cause, "point")
        self.assertIn("too much", reasons[0].reason)
        with self.assertRaises(latsch.Failure):
            study.score([0.9])

    def test_an_interrupted_run_goes_on_to_the_same_bits(self):
        whole = self.compliance("whole", LONG)
        expected = whole.run(workers=2, progress=False)
        study = self.compliance("interrupted", LONG)
        script = textwrap.dedent(f"""
            import latsch
            try:
                latsch.read_study({str(study.file)!r}).run(workers=2, progress=False)
            except KeyboardInterrupt:
                print("interrupted")
            """)
        run = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while len(study.trials()) < 100:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)
        run.send_signal(signal.SIGINT)
        self.assertEqual(run.communicate(timeout=20)[0], "interrupted\n")
        self.assertLess(len(study.trials()), len(whole.trials()))
        result = study.resume(workers=1, progress=False)
        self.assertEqual(result["target"], expected["target"])
        np.testing.assert_array_equal(study.best().point, whole.best().point)

    def test_a_damaged_journal_says_so(self):
        study = self.compliance()
        study.run(progress=False)
        with contextlib.closing(sqlite3.connect(study.journal)) as rows, rows:
            rows.execute("update trials set point = randomblob(length(point)) where number = 3")
        with self.assertRaises(latsch.JournalError) as caught:
            study.trials()
        self.assertIn("3", str(caught.exception))

    def test_wrong_studies_are_refused(self):
        study = self.compliance()
        self.assertEqual((len(study.trials()), study.trials().points.shape, study.best()), (0, (0, 10), None))
        with self.assertRaises(latsch.InputError):
            study.resume()
        with self.assertRaises(latsch.InputError):
            study.target(study.space.initial[:3], {})
        study.file.write_text(study.file.read_text().replace("A/dz_by_Fz", "A/dz_by_Fq"))
        for call in (lambda: latsch.read_study(study.file), study.run):
            with self.assertRaises(latsch.InputError) as caught:
                call()
            self.assertEqual(pathlib.Path(caught.exception.file), study.file)
            self.assertGreater(caught.exception.line, 0)


if __name__ == "__main__":
    unittest.main()
