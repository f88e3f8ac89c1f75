#!/usr/bin/env python3
"""The study reference agrees with the readers of a study, and the program prints it.

    reference_test.py PATH/TO/latsch
"""
import pathlib
import subprocess
import sys
import unittest

from cli_testing import LATSCH

TREE = pathlib.Path(__file__).resolve().parents[3]
PAGE = TREE / "docs" / "study_reference.md"


class Reference(unittest.TestCase):
    def test_the_page_is_what_the_readers_say(self):
        made = subprocess.run([sys.executable, TREE / "tools" / "study_reference.py", "--check"], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_every_key_of_the_studies_that_are_shipped_is_on_it(self):
        page = PAGE.read_text()
        for study in (TREE / "studies").glob("*/study.toml"):
            for line in study.read_text().splitlines():
                key, equal, _ = line.partition(" = ")
                if equal and key.isidentifier():
                    self.assertRegex(page, rf"\b{key}\b", f"{study}: {key}")

    def test_the_program_prints_it(self):
        run = subprocess.run([LATSCH, "help", "study"], capture_output=True, text=True)
        page, own = run.stdout.split("\n## Models and tests of this program\n")
        self.assertEqual(page, PAGE.read_text())
        self.assertRegex(own, r"\| `magic_formula` \| Magic Formula \| a \.tir file \|")
        self.assertRegex(own, r"\| `footprint` \| .* \| fe_tire, inp_tire, ring_tire, rigid_ring, magic_formula \|")


if __name__ == "__main__":
    unittest.main()
