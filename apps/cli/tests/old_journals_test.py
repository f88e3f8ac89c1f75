#!/usr/bin/env python3
"""Journals that older programs wrote (verification/old_journals): each is brought to today's format with a backup, and
the run goes on without a new trial.

Should a search take other steps one day, its new trials are no fault of the journal: what has to hold is that every
trial of the journal is reused.

    old_journals_test.py PATH/TO/latsch
"""
import contextlib
import pathlib
import re
import shutil
import sqlite3
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH, trials_of

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "verification/old_journals"


def format_of(journal):
    with contextlib.closing(sqlite3.connect(f"file:{journal}?mode=ro", uri=True)) as rows:
        return rows.execute("pragma user_version").fetchone()[0]


class OldJournals(unittest.TestCase):
    def goes_on(self, journal):
        with tempfile.TemporaryDirectory(prefix="latsch_old_") as scratch:
            folder = pathlib.Path(shutil.copytree(journal.parent, pathlib.Path(scratch) / "study"))
            shutil.copy(journal, folder / "study.latsch")
            written = int(journal.stem.removeprefix("format"))
            self.assertEqual(format_of(folder / "study.latsch"), written)
            trials = trials_of(folder / "study.latsch")
            self.assertGreater(trials, 30)
            ran = subprocess.run([LATSCH, "run", "study.toml"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(ran.returncode, DONE, ran.stderr)
            self.assertEqual(int(re.search(r"(\d+) finished trials are reused", ran.stdout)[1]), trials)
            self.assertEqual(trials_of(folder / "study.latsch"), trials)
            self.assertGreater(format_of(folder / "study.latsch"), written)
            backup = folder / f"study.latsch.format{written}"
            self.assertEqual((format_of(backup), trials_of(backup)), (written, trials))

    def test_every_one_of_them_goes_on(self):
        journals = sorted(STUDIES.glob("*/format*.journal"))
        self.assertGreaterEqual(len(journals), 2)
        for journal in journals:
            with self.subTest(journal.relative_to(STUDIES)):
                self.goes_on(journal)


if __name__ == "__main__":
    unittest.main()
