#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests that the examples that `latsch help VERB` shows can be pasted: each line is a command or a comment, the
shipped files that it names exist, and the quick ones run, in the order of the page, in a folder with the shipped
studies."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import LATSCH

SOURCE = pathlib.Path(__file__).resolve().parents[4]

# Examples that take longer than a test may, need a cluster or do not end by themselves. Their verbs have separate
# tests.
NOT_RUN = re.compile(r"mpirun|srun|latsch (run|resume|sample|identify|doe|serve|compare|process)\b|--place-columns|mesh .*--convergence"
                     r"|slow\.toml|tire_b_twin|--ccx|--vtu|--drum |--size|baseline.toml --fmu")


def said(*arguments):
    return subprocess.run([LATSCH, *arguments], capture_output=True, text=True, check=True).stdout


def verbs():
    return re.findall(r"^  ([a-z]+) ", said("--help").split("Subcommands:\n")[1].split("\n\n")[0], re.M)


def examples(verb):
    """Returns the lines below "Example:" or "Examples:", up to the next empty line."""
    found = re.search(r"^Examples?:\n((?:  .*\n?)+)", said("help", verb), re.M)
    return [line[2:] for line in found[1].splitlines()] if found else []


class HelpExamples(unittest.TestCase):
    def test_every_verb_has_examples_that_are_commands_or_comments(self):
        self.assertGreater(len(verbs()), 15)
        for verb in verbs():
            lines = examples(verb)
            with self.subTest(verb):
                self.assertTrue(lines)
                for line in lines:
                    self.assertRegex(line, r"^(latsch|mpirun|srun|printf) |^# [A-Z].*\.$")
                    # Words behind two blanks must be a comment, because a shell would read them as arguments.
                    self.assertNotRegex(line.split(" # ")[0].rstrip(), r"\S  +\S")

    def test_shipped_files_of_examples_exist(self):
        for verb in verbs():
            for name in re.findall(r"studies/[\w/.]+", " ".join(examples(verb))):
                self.assertTrue((SOURCE / name).exists(), f"{verb}: {name}")

    def test_quick_examples_run(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(SOURCE / "studies", f"{folder}/studies")
            (pathlib.Path(folder) / "bin").mkdir()
            os.symlink(shutil.which(LATSCH), f"{folder}/bin/latsch")
            shell = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"}
            ran = 0
            for line in sum((examples(verb) for verb in dict.fromkeys(["new", *verbs()])), []):
                if line.startswith("#") or NOT_RUN.search(line) or "my_tire/study" in line:
                    continue
                done = subprocess.run(line, shell=True, cwd=folder, env=shell, capture_output=True, text=True, timeout=300)
                shown = f"{line}\n{done.stdout[-500:]}{done.stderr[-500:]}"
                self.assertIn(done.returncode, (0, 1) if "validate" in line else (0,), shown)
                ran += 1
        self.assertGreater(ran, 15)


if __name__ == "__main__":
    unittest.main(argv=["help_examples_test"])
