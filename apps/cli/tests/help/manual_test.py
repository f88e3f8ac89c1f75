#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests that the manual page and the completion of the shell have every verb, its options and their values, as the
program's help has them.

   manual_test.py PATH/TO/latsch"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import LATSCH

ROOT = pathlib.Path(__file__).resolve().parents[4]


def said(*arguments):
    return subprocess.run([LATSCH, *arguments], capture_output=True, text=True, check=True).stdout


VERBS = re.findall(r"^  ([a-z]+) {2,}", said("help").split("Subcommands:")[1].split("\n\n")[0], re.M)


def completed(*words):
    """Returns the completions that a Tab after these words offers."""
    script = (f"source {ROOT}/cmake/package/latsch.bash; COMP_WORDS=({LATSCH} {' '.join(words)} ''); "
              f"[ -n '{words[-1] if words else ''}' ] && unset 'COMP_WORDS[-1]'; COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); "
              'COMPREPLY=(); _latsch; printf "%s\\n" "${COMPREPLY[@]}"')
    run = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
    return run.stdout.split()


class Manual(unittest.TestCase):
    def test_it_has_a_section_for_every_verb(self):
        self.assertIn("resume", VERBS)
        with tempfile.NamedTemporaryFile(suffix=".1") as page:
            subprocess.run(["python3", ROOT / "tools/man_page.py", LATSCH, page.name], check=True)
            text = pathlib.Path(page.name).read_text()
        self.assertEqual(re.findall(r"^\.SH latsch (.*)$", text, re.M), VERBS)
        for option in re.findall(r"--[a-z-]+", said("help", "run")):
            self.assertIn(option.replace("-", "\\-"), text)


class Completion(unittest.TestCase):
    def test_verbs(self):
        self.assertEqual(set(completed()), {*VERBS, "--version", "--help"})
        self.assertEqual(completed("res"), ["resume"])
        self.assertEqual(set(completed("help", "re")), {"resume", "report"})
        self.assertEqual(completed("help", "stu"), ["study"])

    def test_options_and_their_values(self):
        self.assertEqual(completed("run", "--wor"), ["--workers"])
        self.assertEqual(set(completed("run", "--")), set(re.findall(r"--[a-z-]+", said("help", "run").split("[run]")[0])))
        self.assertEqual(set(completed("test", "--signs", "a")), {"adams"})
        self.assertEqual(completed("run", "stud"), [])  # no candidates: bash then completes file names


if __name__ == "__main__":
    unittest.main()
