#!/usr/bin/env python3
"""Tests a mesh in a user's .inp file with every verb that accepts a tire: check, show, test, mesh, a study, export.

   inp_test.py PATH/TO/latsch"""
import json
import pathlib
import re
import unittest

from cli_testing import WRONG_INPUT, Coarse, edit

DECKS = pathlib.Path(__file__).resolve().parents[4] / "shared/data/ccx"
PRESS = '{kind = "load_deflection", deflections = ["6 mm", "12 mm"]}'
STUDY = """title = "twin of a deck"
model = "tire.inp"
[variable.sidewall]
path = "PATH"
lower = "0.4 MPa"
upper = "3 MPa"
initial = "1.6 MPa"
scale = "logarithmic"
[experiment.stiffness]
kind = "load_deflection"
measurement = "stiffness.csv"
deflections = {unit = "mm", values = [6, 12]}
[experiment.modes]
kind = "modes"
measurement = "modes.csv"
measured_modes = 6
[optimizer]
method = "auto"
[run]
workers = 1
"""


def channels_of(output):
    answer, _ = json.JSONDecoder().raw_decode(output)  # warnings follow the answer
    return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}


class Deck(Coarse):
    """Returns the coarse tire as a deck that the program wrote."""

    def setUp(self):
        super().setUp()
        self.deck = self.folder / "tire.inp"
        self.latsch("export", self.folder / "tire.toml", "--ccx", self.deck, "--deflection", "12 mm", "--modes", "6")
        paths = self.latsch("check", self.deck)
        self.C10 = re.findall(r"(material\.\S+\.C10) +(\S+) Pa", paths)

    def channels(self, model, test):
        return channels_of(self.latsch("test", model, test, "--json"))

    def test_check_says_what_it_is_and_which_numbers_may_vary(self):
        self.assert_says(self.latsch("check", self.deck), "tire.inp, finite-element tire on the user's mesh",
                         "elements C3D8I", "18 equal sectors", "pressure", "density", "kg/m^3")
        self.assertGreaterEqual(len(self.C10), 2)

    def test_show_lists_its_numbers(self):
        page = self.folder / "tire.html"
        self.latsch("show", self.deck, "--html", page)
        self.assert_says(page.read_text(), "Finite-element deck", self.C10[0][0])

    def test_answers_as_the_tire_it_was_written_from(self):
        """Checks a deck of solid elements with smeared cords."""
        edit(self.folder / "tire.toml", ('cords = "rebar"', 'cords = "smeared"\nelement = "full_integration"'))
        self.latsch("export", self.folder / "tire.toml", "--ccx", self.deck, "--deflection", "12 mm", "--modes", "6")
        for test in (PRESS, '{kind = "modes", count = 6}', '{kind = "modes", count = 6, deflection = "12 mm"}'):
            theirs, ours = self.channels(self.deck, test), self.channels(self.folder / "tire.toml", test)
            name = "force" if test == PRESS else "frequency"
            for a, b in zip(theirs[name], ours[name], strict=True):
                self.assertAlmostEqual(a / b, 1.0, delta=1e-5)

    def test_answers_as_the_tire_with_cords_as_springs(self):
        """Checks the deck of the tire itself. Its cords are springs, which become layers again, and comments state
        its walls, its tread and, if it has zones, the division into sectors of the tire on the ground. Numbers in a
        deck have 12 to 15 digits."""
        self.assertIn("TYPE=SPRINGA", self.deck.read_text())
        tire = self.folder / "tire.toml"
        for zones, loaded in ((False, True), (False, False), (True, False), (True, True)):
            if zones and not loaded:
                edit(tire, (r"\nsectors = 18", '\nsectors = 18\nsector_zones = [[3, "8 deg"]]'))
            more = ("--deflection", "12 mm") if loaded else ()
            self.latsch("export", tire, "--ccx", self.deck, *more, "--modes", "6")
            for test in (PRESS, '{kind = "inflation"}', '{kind = "modes", count = 6}'):
                theirs, ours = self.channels(self.deck, test), self.channels(tire, test)
                name = "force" if test == PRESS else "growth" if "inflation" in test else "frequency"
                for a, b in zip(theirs[name], ours[name], strict=True):
                    self.assertAlmostEqual(a / b, 1.0, delta=1e-6, msg=f"zones {zones}, loaded {loaded}, {test}")

    def test_export_says_how_far_another_program_is_and_check_what_a_deck_without_comments_lacks(self):
        tire = self.folder / "tire.toml"
        edit(tire, (r"\nsectors = 18", '\nsectors = 18\nsector_zones = [[3, "8 deg"]]'))
        self.assert_says(self.latsch("export", tire, "--ccx", self.deck), "its sectors are equal", "a comment keeps")
        self.assert_says(self.latsch("export", tire, "--ccx", self.deck, "--deflection", "12 mm"),
                         "sectors are of unequal width", "does not keep such a ring round", "1.0 % less force")
        self.assertNotIn("it states no walls", self.latsch("check", self.deck))
        self.deck.write_text(re.sub(r"(?m)^\*\* latsch .*\n", "", self.deck.read_text()))
        self.assert_says(self.latsch("check", self.deck), "it states no walls", "1.6 %")

    def test_mesh_counts_it_and_refines_none(self):
        self.assert_says(self.latsch("mesh", self.deck), "sectors", "mass")
        self.assert_says(self.latsch("mesh", self.deck, "--refinement", "2", code=WRONG_INPUT), "cannot be refined")

    def test_a_twin_study_finds_its_modulus_and_writes_the_deck_back(self):
        path, value = min(self.C10, key=lambda one: float(one[1]))
        study = self.folder / "deck.toml"
        study.write_text(STUDY.replace("PATH", path))
        self.latsch("export", study, "--measurements")
        self.assert_says(self.latsch("check", study), "sidewall")
        self.latsch("run", study)
        found = self.folder / "found.inp"
        self.latsch("export", study, "--model", found)
        before, after = self.deck.read_text().splitlines(), found.read_text().splitlines()
        # The exported file begins with comments on the fit from which it comes.
        self.assertGreater(len(after), len(before))
        self.assertTrue(all(line.startswith("**") for line in after[:len(after) - len(before)]), after[:20])
        after = after[len(after) - len(before):]
        changed = [(a, b) for a, b in zip(before, after) if a != b]
        self.assertEqual(len(changed), 1, changed)  # all but C10 are unchanged
        (a, b), = changed
        self.assertEqual(a.split(",")[1:], b.split(",")[1:])
        self.assertAlmostEqual(float(b.split(",")[0]) / (float(value) * 1e-6), 1.0, delta=1e-4)
        self.assert_says(self.latsch("check", found), path)

    def test_other_files_from_it(self):
        for option, name in (("--vtu", "a.vtu"), ("--ccx", "a.inp"), ("--model", "b.inp")):
            self.latsch("export", self.deck, option, self.folder / name)
            self.assertGreater((self.folder / name).stat().st_size, 1000)
        self.assertEqual((self.folder / "b.inp").read_bytes(), self.deck.read_bytes())

    def test_what_is_no_tire_is_refused_with_its_line(self):
        text = self.deck.read_text()
        for old, new, *parts in (
                ("TYPE=C3D8I", "TYPE=C3D10", "element type C3D10 is not supported", "expected C3D8"),
                ("*HYPERELASTIC,NEO HOOKE", "*HYPERELASTIC,OGDEN", "expected NEO HOOKE or MOONEY-RIVLIN"),
                ("*STATIC", "*DYNAMIC", "keyword *DYNAMIC is not supported"),
                ("*HEADING", "** units: mm, kN, kg\n*HEADING", "other units than above")):
            self.deck.write_text(text.replace(old, new))
            self.assert_says(self.latsch("check", self.deck, code=WRONG_INPUT), *parts)
            self.assertRegex(self.latsch("test", self.deck, PRESS, code=WRONG_INPUT), r"tire\.inp:\d+: ")

    def test_a_truncated_one_is_a_clear_error(self):
        text = self.deck.read_text()
        for part in (0.05, 0.3, 0.6, 0.9, 0.999):
            self.deck.write_text(text[:int(part * len(text))])
            self.assert_says(self.latsch("check", self.deck, code=WRONG_INPUT), "tire.inp", "expected")

    def test_a_file_changed_after_it_was_read_is_not_taken_for_it(self):
        path, _ = self.C10[0]
        study = self.folder / "deck.toml"
        study.write_text(STUDY.replace("PATH", path))
        self.latsch("export", study, "--measurements")
        edit(study, ("method = .*", 'method = "auto"\nmax_steps = 1'))
        self.latsch("run", study)
        self.deck.write_text(self.deck.read_text().replace("*HEADING", "** another\n*HEADING"))
        self.assertNotEqual(self.latsch("resume", study, code=WRONG_INPUT), "")


class SharedDecks(unittest.TestCase):
    latsch, assert_says = Coarse.latsch, Coarse.assert_says

    def test_the_decks_of_an_independent_generator(self):
        if not DECKS.exists():
            self.skipTest(f"no decks in {DECKS}")
        for name in ("tire_b_loaded", "tire_b_unloaded"):
            self.assert_says(self.latsch("check", DECKS / f"{name}.inp"), "60 equal sectors", "pressure")
        modes = channels_of(self.latsch("test", DECKS / "tire_b_unloaded.inp", '{kind = "modes", count = 4}', "--json"))
        for ours, theirs in zip(modes["frequency"], (32.499, 39.142, 39.142, 42.193), strict=True):  # CalculiX 2.20
            self.assertAlmostEqual(ours / theirs, 1.0, delta=3e-3)


if __name__ == "__main__":
    unittest.main()
