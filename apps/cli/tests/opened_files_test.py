#!/usr/bin/env python3
"""Tests that every file that `latsch check` opens for a shipped study has a ledger in its answer. The kernel reports
the opened files (inotify), so a new reader without a ledger fails this test.

   opened_files_test.py PATH/TO/latsch"""
import ctypes
import json
import os
import pathlib
import struct
import subprocess
import unittest

from cli_testing import DONE, LATSCH

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"
IN_OPEN = 0x20
# Endings of file names that are no input: results of earlier runs and files that a run writes.
NO_INPUT = (".latsch", ".latsch-wal", ".latsch-shm", ".journal", ".journal-wal", ".journal-shm", ".db", ".html", ".log", ".lock")


class Opened:
    """Records which regular files are opened in the folders and their subfolders."""

    def __init__(self, folders):
        self.libc = ctypes.CDLL(None, use_errno=True)
        self.descriptor = self.libc.inotify_init1(os.O_NONBLOCK)
        if self.descriptor < 0:
            raise OSError(ctypes.get_errno(), "inotify_init1")
        self.folders = {}
        for top in folders:
            for folder, _, _ in os.walk(top):
                watch = self.libc.inotify_add_watch(self.descriptor, folder.encode(), IN_OPEN)
                if watch < 0:
                    raise OSError(ctypes.get_errno(), f"inotify_add_watch {folder}")
                self.folders[watch] = pathlib.Path(folder)

    def files(self):
        opened = set()
        while True:
            try:
                events = os.read(self.descriptor, 1 << 20)
            except BlockingIOError:
                return opened
            at = 0
            while at < len(events):
                watch, mask, _, length = struct.unpack_from("iIII", events, at)
                name = events[at + 16:at + 16 + length].rstrip(b"\0").decode()
                at += 16 + length
                file = self.folders.get(watch, pathlib.Path()) / name
                if name and mask & IN_OPEN and file.is_file():
                    opened.add(file.resolve())

    def close(self):
        os.close(self.descriptor)


class OpenedFiles(unittest.TestCase):
    def check(self, study):
        try:
            opened = Opened([STUDIES])
        except OSError as error:
            self.skipTest(f"no inotify here: {error}")
        try:
            run = subprocess.run([LATSCH, "check", study, "--json"], capture_output=True, text=True, timeout=300)
            self.assertEqual(run.returncode, DONE, run.stderr)
            files = {file for file in opened.files()
                     if not file.name.endswith(NO_INPUT) and file != study.resolve()}
        finally:
            opened.close()
        answer = json.loads(run.stdout)["result"]
        ledgers = {}
        for ledger in answer["ledgers"]:
            ledgers.setdefault(pathlib.Path(ledger["file"]).resolve(), ledger)
        return files, ledgers

    def test_every_opened_file_of_every_shipped_study_has_a_ledger(self):
        studies = sorted(STUDIES.glob("*/study*.toml"))
        self.assertGreaterEqual(len(studies), 12)
        kinds = set()
        for study in studies:
            with self.subTest(study=str(study.relative_to(STUDIES))):
                files, ledgers = self.check(study)
                missing = sorted(str(file.relative_to(STUDIES)) for file in files - ledgers.keys())
                self.assertEqual(missing, [], "opened, and in no ledger")
                for file in files:
                    kinds.add(file.suffix)
                    self.assertTrue(ledgers[file]["rows"], f"{file} has a ledger without rows")
                    for row in ledgers[file]["rows"]:
                        said = row["taken_as"] or row["state"] == "not used" or row["remark"] or row["used_by"]
                        self.assertTrue(said, f"{file}: {row}")
        self.assertLessEqual({".toml", ".csv", ".tir"}, kinds)


if __name__ == "__main__":
    unittest.main()
