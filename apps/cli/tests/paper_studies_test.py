#!/usr/bin/env python3
"""Tests the studies of tires whose measurements come from another program or rig: every file passes the check, and
the quickest study runs.

   paper_studies_test.py PATH/TO/latsch"""
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

from cli_testing import LATSCH, WRONG_INPUT, Coarse

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"
FILES = {
    "tire_b_uniqueness": ["study", "force"],
    "tire_b_stiffness_transfer": ["modes_1", "modes_3", "modes_5"],
    "measurement_guideline": ["study"],
    "tire_a": ["three", "five", "masses", "laboratory"],
    "tire_b_specimen": ["laboratory"],
    "foreign_truth": ["same_mesh", "shipped_element"],
}


class Files(Coarse):
    def test_check_finds_every_study_in_order(self):
        for folder, names in FILES.items():
            for name in names:
                with self.subTest(study=f"{folder}/{name}"):
                    self.assert_says(self.latsch("check", STUDIES / folder / (name + ".toml")), "Everything is in order")


class ForeignTruth(Coarse):
    def test_the_comparison_element_finds_the_moduli_of_CalculiX_deck_and_its_forces_at_other_pressures(self):
        """Compares one trial at the moduli of the tire's file with results of CalculiX: fitted forces agree within
        0.1 %, others within 0.3 %."""
        folder = self.folder / "foreign_truth"
        shutil.copytree(STUDIES / "foreign_truth", folder, ignore=shutil.ignore_patterns("*.latsch*", "*.html"))
        answer = json.JSONDecoder().raw_decode(self.latsch("run", folder / "same_mesh.toml", "--json"))[0]["result"]
        found = {v["name"]: v["value"] for v in answer["variables"]}
        for name, truth in {"matrix": 5.960264900662252, "carcass": 2000.0, "belt": 20000.0}.items():
            self.assertAlmostEqual(found[name] / truth, 1.0, delta=1e-3, msg=name)
        sets = [x for name, value in found.items() for x in ("--set", f"{name}={value!r} N/mm^2")]
        answer = json.JSONDecoder().raw_decode(self.latsch("simulate", folder / "same_mesh.toml", *sets, "--json"))[0]
        errors = {e["name"]: e for e in answer["result"]["experiments"]}
        for name in ("stiffness_22", "stiffness_30"):
            self.assertFalse(errors[name]["fitted"])
            self.assertLess(errors[name]["largest_error"], 3e-3, name)


class Guideline(Coarse):
    def test_the_table_of_the_README_follows_from_the_sensitivities(self):
        folder = self.folder / "guideline"
        shutil.copytree(STUDIES / "measurement_guideline", folder)
        table = subprocess.run([sys.executable, folder / "guideline.py"], check=True, capture_output=True, text=True).stdout
        self.assertIn(table.strip(), (folder / "README.md").read_text())


class Extent(Coarse):
    def test_doe_says_how_far_points_below_a_level_reach(self):
        text = self.latsch("doe", self.study, "--levels", "3", "--level", "100 %")
        self.assert_says(text, "Targets of at most 100 %: 9 points", "sidewall extends over its whole range")
        self.assert_says(self.latsch("doe", self.study, "--levels", "3", "--level", "0.0001 %"), "No point has a target")
        self.assert_says(self.latsch("doe", self.study, "--levels", "3", "--level", "2 mm", code=WRONG_INPUT), "level")
        self.assert_says(self.latsch("doe", self.study, "--levels", "3", "--level", "2", code=WRONG_INPUT), 'expected "2 %"')


if __name__ == "__main__":
    unittest.main()
