#!/usr/bin/env python3
"""Tests journals that older versions of the program wrote (verification/old_journals). A journal of an outside
program in format 4 is converted to the present format with a backup, and the run continues. A journal that lacks a
key or file of its tests, the version of the model or the files of the program is refused with a message that says so,
and `--adopt` reuses its trials.

A later version of the search may take other steps and so add trials; the test requires only that every trial of the
journal is reused.

   old_journals_test.py PATH/TO/latsch"""
import contextlib
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cli_testing import DONE, LATSCH, WRONG_INPUT, trials_of

STUDIES = pathlib.Path(__file__).resolve().parents[4] / "verification/old_journals"


def format_of(journal):
    with contextlib.closing(sqlite3.connect(f"file:{journal}?mode=ro", uri=True)) as rows:
        return rows.execute("pragma user_version").fetchone()[0]


class OldJournals(unittest.TestCase):
    def setUp(self):
        self.scratch = pathlib.Path(tempfile.mkdtemp(prefix="latsch_old_"))
        self.addCleanup(shutil.rmtree, self.scratch)

    def study_with(self, journal):
        """Copies the study together with the given journal."""
        self.folder = self.scratch / f"{journal.parent.name}_{journal.stem}"
        shutil.copytree(journal.parent, self.folder)
        self.journal = self.folder / "study.latsch"
        shutil.copy(journal, self.journal)
        self.written, self.trials = format_of(self.journal), trials_of(self.journal)
        self.assertEqual(self.written, int(journal.stem.removeprefix("format")))
        self.assertGreater(self.trials, 10)

    def latsch(self, *arguments):
        return subprocess.run([LATSCH, *arguments], cwd=self.folder, capture_output=True, text=True)

    def assert_taken_over(self, ran):
        self.assertEqual(ran.returncode, DONE, ran.stderr)
        self.assertEqual(int(re.search(r"(\d+) finished trials are reused", ran.stdout)[1]), self.trials)
        self.assertGreater(format_of(self.journal), self.written)
        backup = self.folder / f"study.latsch.format{self.written}"
        self.assertEqual((format_of(backup), trials_of(backup)), (self.written, self.trials))

    def test_one_of_format_4_goes_on(self):
        self.study_with(STUDIES / "program/format4.journal")
        self.assert_taken_over(self.latsch("run", "study.toml"))

    def test_an_adopted_one_needs_no_new_trial(self):
        self.study_with(STUDIES / "magic_formula/format4.journal")
        self.assert_taken_over(self.latsch("resume", "study.toml", "--adopt"))
        self.assertEqual(trials_of(self.journal), self.trials)
        self.assertEqual(self.latsch("run", "study.toml").returncode, DONE)  # a journal has to be adopted only once
        self.assertEqual(trials_of(self.journal), self.trials)

    def test_one_of_another_model_cannot_be_adopted(self):
        self.study_with(STUDIES / "magic_formula/format4.journal")
        tire = self.folder / "tire.tir"
        text, count = re.subn(r"\nPDY2 = -0.1\n", "\nPDY2 = -0.2\n", tire.read_text())
        self.assertEqual(count, 1)
        tire.write_text(text)
        refused = self.latsch("resume", "study.toml", "--adopt")
        self.assertEqual(refused.returncode, WRONG_INPUT)
        self.assertIn('"model" differs', refused.stderr)

    def test_older_ones_do_not_say_all_they_depend_on_and_have_to_be_adopted(self):
        tests = "every key of its tests and the content of every file they name"
        for name, lacks in (("fe_tire/format1", tests), ("magic_formula/format4", tests), ("program/format2", '"program files"'),
                            ("program/format3", '"program files"')):
            with self.subTest(name):
                self.study_with(STUDIES / f"{name}.journal")
                refused = self.latsch("run", "study.toml")
                self.assertEqual(refused.returncode, WRONG_INPUT)
                for words in (lacks, "it is older and does not contain", "--anew", "--adopt"):
                    self.assertIn(words, refused.stderr)
                self.assertEqual((format_of(self.journal), trials_of(self.journal)), (self.written, self.trials))
                self.assert_taken_over(self.latsch("resume", "study.toml", "--adopt"))


if __name__ == "__main__":
    unittest.main()
