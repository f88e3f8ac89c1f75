#!/usr/bin/env python3
"""Tests that docs/study_reference.md and `latsch help study` agree with the keys that a study may have.

   reference_test.py PATH/TO/latsch"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from cli_testing import LATSCH

TREE = pathlib.Path(__file__).resolve().parents[3]
PAGE = TREE / "docs" / "study_reference.md"


def said(*arguments):
    return subprocess.run([LATSCH, *arguments], capture_output=True, text=True, check=True).stdout


def sections():
    return {one["heading"]: one for one in json.loads(said("help", "study", "--json"))["result"]["sections"]}


class Reference(unittest.TestCase):
    def test_the_page_is_what_the_program_says(self):
        made = subprocess.run([sys.executable, TREE / "tools" / "study_reference.py", LATSCH, "--check"], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_the_tool_reads_no_source(self):
        tool = (TREE / "tools" / "study_reference.py").read_text()
        self.assertNotRegex(tool, r"\.cpp|\.h\b|import re\b|src")

    def test_every_key_of_the_studies_that_are_shipped_is_on_it(self):
        page = PAGE.read_text()
        for study in (TREE / "studies").glob("*/study.toml"):
            for line in study.read_text().splitlines():
                key, equal, _ = line.partition(" = ")
                if equal and key.isidentifier():
                    self.assertRegex(page, rf"\b{key}\b", f"{study}: {key}")

    def test_the_program_prints_it_and_its_models(self):
        page, own = said("help", "study").split("\n## Models and tests of this program\n")
        self.assertEqual(page, PAGE.read_text())
        self.assertRegex(own, r"\| `magic_formula` \| Magic Formula \| a \.tir file \|")
        self.assertRegex(own, r"\| `footprint` \| .* \| fe_tire, inp_tire, ring_tire, rigid_ring, magic_formula \|")

    def test_one_kind_of_test_or_table_is_printed_alone(self):
        whole = PAGE.read_text()
        for topic, part, heading in (
            ("test", "rolling", '## Test "rolling"'),
            ("study", "optimizer", "## [optimizer]"),
            ("study", "variable", "## [variable.NAME]"),
            ("study", "suite", "## A suite"),
        ):
            text = said("help", topic, part)
            self.assertTrue(text.startswith(heading), text[:80])
            self.assertLess(len(text), 0.2 * len(whole))
            for section in ("## " + one for one in text.split("## ")[1:]):
                self.assertIn(section.strip(), whole)

    def test_every_kind_of_test_has_its_keys(self):
        for heading in sections():
            if name := re.match(r'Test "(\w+)"', heading):
                self.assertIn(heading, said("help", "test", name[1]))

    def test_an_unknown_part_is_answered_with_what_there_is(self):
        done = subprocess.run([LATSCH, "help", "test", "roling"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn('did you mean "rolling"', done.stderr)
        self.assertIn("optimizer", done.stderr)

    def test_programs_get_kind_unit_range_choices_default_and_sentence_of_every_key(self):
        found = sections()
        keys = [key for section in found.values() for key in section["keys"]]
        self.assertGreater(len(keys), 300)
        for key in keys:
            self.assertTrue(key["sentence"].endswith("."), key)
            self.assertTrue(key["forms"], key)
        drum = {key["path"]: key for key in found['Test "drum_cleat": over a cleat on the drum']["keys"]}
        self.assertEqual(drum["drum_diameter"]["forms"], [{"kind": "quantity", "units": ["m"], "lower": 0.2, "lower_excluded": False, "upper": 100.0}])
        self.assertEqual(drum["passages"]["defaults"], ["1"])
        self.assertTrue(drum["speed"]["required"])
        self.assertEqual(found["[run]"]["table"], "run")
        failure = next(key for key in found["[run]"]["keys"] if key["path"] == "on_failure")
        self.assertEqual(failure["forms"][0]["choices"], ["proceed", "abort", "retry", "recover", "continuation"])

    def test_no_word_of_the_program_s_code_is_on_the_page(self):
        self.assertNotRegex(PAGE.read_text(), r"\bk[A-Z][a-z]{2,}\w*|any_model|\w+_keys\b|std::|\w+\.h\b")

    def test_units_of_examples_are_those_of_their_keys(self):
        """Tests that the unit of a scale is a time if x is a time, and that "10 %" is allowed only if x has no unit.
        """
        rows = [line for line in PAGE.read_text().splitlines() if line.startswith("| `x_scale`")]
        self.assertEqual(len(rows), 1)
        self.assertIn('"10 ms" over time', rows[0])
        self.assertIn("only where x has no unit", rows[0])
        self.assertNotRegex(PAGE.read_text(), r"noise = \{\w+ = 20\}")

    def test_every_example_is_a_sample_that_was_read(self):
        samples = [sample for section in sections().values() for sample in section["samples"]]
        page = PAGE.read_text()
        self.assertGreater(sum(sample in page for sample in samples), 35)

    def test_the_schema_of_every_kind_of_file_is_printed(self):
        files = sorted((TREE / "docs" / "schemas").glob("latsch-*.json"))
        self.assertGreaterEqual(len(files), 11)
        for file in files:
            self.assertEqual(said("help", "--schema", file.stem.removeprefix("latsch-")), file.read_text())

    def test_an_unknown_kind_of_file_is_answered_with_what_there_is(self):
        done = subprocess.run([LATSCH, "help", "--schema", "studi"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn('did you mean "study"', done.stderr)
        self.assertIn("fe_tire", done.stderr)

    def test_files_of_latsch_new_name_their_schemas(self):
        """Tests every file that `latsch new` writes without a recording."""
        kinds = {"study": "study", "tire": "fe_tire", "ring": "ring_tire", "corner": "suspension", "front": "suspension",
                 "rear": "suspension", "car": "car", "kerb": "test"}
        with tempfile.TemporaryDirectory() as folder:
            written = {}
            for number, options in enumerate((["--coarse"], ["--suspension"], ["--car"], ["--ring-data"])):
                said("new", f"{folder}/{number}", *options)
                for file in pathlib.Path(folder, str(number)).glob("*.toml"):
                    first = file.read_text().splitlines()[0]
                    # This program is not installed in /usr, so that a copy lies beside the file.
                    self.assertTrue(first.startswith("#:schema ./"), f"{file}: {first}")
                    named = file.parent / first.removeprefix("#:schema ./")
                    self.assertEqual(named.read_text(), (TREE / "docs" / "schemas" / named.name).read_text())
                    written[file.stem] = named.stem
            self.assertEqual(written, {stem: f"latsch-{kind}" for stem, kind in kinds.items()})

    def test_help_of_a_verb_is_in_the_answer_for_programs(self):
        self.assertIn("latsch help", json.loads(said("help", "--json"))["result"]["text"])
        self.assertIn("--set", json.loads(said("help", "simulate", "--json"))["result"]["text"])


if __name__ == "__main__":
    unittest.main()
