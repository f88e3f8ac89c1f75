#!/usr/bin/env python3
"""Tests `latsch new` for every shipped tire and for random sizes: the written files pass the check and can be fitted.

   new_test.py PATH/TO/latsch"""
import json
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, assert_identifiability

TIRES = sorted(p.stem for p in (pathlib.Path(__file__).resolve().parents[3] / "studies" / "tires").glob("*.toml"))
SHIPPED = [name for name in TIRES if not name.startswith("comparison_")]

WIDTHS, ASPECTS, RIMS = range(145, 326, 10), range(30, 81, 5), range(13, 22)  # mm, %, inches
HEIGHTS = (62, 150)  # mm, section height: sizes 325/30 and 185/80 exist, a 325/80 does not


def drawn_sizes(count, seed=2024):
    """Returns sizes of car tires in the steps of the standards, inside WIDTHS, ASPECTS, RIMS and
    HEIGHTS."""
    chance, sizes = random.Random(seed), []
    while len(sizes) < count:
        width, aspect, rim = chance.choice(WIDTHS), chance.choice(ASPECTS), chance.choice(RIMS)
        if HEIGHTS[0] <= width * aspect / 100 <= HEIGHTS[1]:
            sizes.append(f"{width}/{aspect}R{rim}")
    return sizes


class New(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_new_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout + run.stderr

    def new(self, *arguments):
        """Checks the study of a coarse tire, and that the default mesh can be built."""
        name = arguments[-1].replace("/", "_")
        self.latsch("new", self.folder / name, "--coarse", *arguments)
        return self.folder / name / "study.toml"

    def test_every_tire_that_is_shipped_and_drawn_sizes_pass_their_own_check(self):
        self.assertGreaterEqual(len(SHIPPED), 4)
        for arguments in [("--tire", name) for name in SHIPPED] + [("--size", size) for size in drawn_sizes(12)]:
            with self.subTest(arguments):
                text = self.latsch("check", self.new(*arguments))
                self.assertIn("Everything is in order", text)
                self.assertNotIn("warning", text)

    def test_a_tire_gets_its_own_data(self):
        study = self.new("--tire", "race_16x7.5-10")
        self.assertIn('"83 kPa"', study.read_text())
        deepest = float((study.parent / "stiffness.csv").read_text().splitlines()[-1].split(",")[0])
        self.assertLess(deepest, 25e-3 if deepest < 1 else 25)

    def test_fits_end_inside_their_bounds_at_a_small_target(self):
        for arguments in (("--size", "275/35R19"), ("--tire", "race_16x7.5-10"), ("--tire", "passenger_205_55R16")):
            with self.subTest(arguments):
                study = self.new(*arguments)
                text = study.read_text()
                study.write_text(text.replace("[run]", "[run]\nintervals = false").replace("0.005", "0.02"))
                found = json.loads(subprocess.run([LATSCH, "run", study, "--json"], capture_output=True, text=True,
                                                  timeout=300).stdout)["result"]
                bounds = {v["name"]: v for v in json.loads(subprocess.run(
                    [LATSCH, "check", study, "--json"], capture_output=True, text=True).stdout)["result"]["variables"]}
                self.assertLess(found["target"], 0.01)
                self.assertLessEqual(found["trials"], 10)  # derivatives come with every trial
                for variable in found["variables"]:
                    limits = bounds[variable["name"]]
                    self.assertEqual(variable["unit"], limits["unit"])
                    self.assertGreater(variable["value"], 1.05 * limits["lower"], variable)
                    self.assertLess(variable["value"], 0.95 * limits["upper"], variable)

    def test_the_identifiability_of_a_tire_is_shown(self):
        study = self.new("--tire", "race_16x7.5-10")
        study.write_text(study.read_text().replace("0.005", "0.02"))
        found = self.found(study)
        assert_identifiability(self, study.parent, [one["name"] for one in found["variables"]])

    def test_the_size_is_the_tires(self):
        tire = (self.new("--size", "275/35R19").parent / "tire.toml").read_text()
        self.assertIn('size = "275/35R19"', tire)
        self.assertIn("9.5 inches wide", tire)  # the measuring rim of that size
        self.assertNotIn("# A 205/55R16", tire)

    def test_columns_of_elements_are_placed_for_the_size(self):
        self.latsch("new", self.folder / "tall", "--size", "195/65R15")
        tire = self.folder / "tall" / "tire.toml"
        columns = re.search(r"^columns = .*$", tire.read_text(), re.M)[0]
        self.assertNotIn(columns, self.latsch("new", self.folder / "low", "--size", "205/55R16")
                         + (self.folder / "low" / "tire.toml").read_text())
        self.assertLessEqual(json.loads(self.latsch("mesh", tire, "--json"))["result"]["free_degrees_of_freedom"], 23220)

    def test_a_mesh_is_written_with_its_columns_placed(self):
        study = self.new("--tire", "passenger_205_55R16")
        placed = self.folder / "placed.toml"
        said = self.latsch("mesh", study.parent / "tire.toml", "--place-columns", placed, "--modes", "6")
        self.assertIn("largest error of growth and 6 modes", said)
        self.assertRegex(placed.read_text(), r"(?m)^columns = \[0, ")
        self.assertNotIn("meridional", placed.read_text())
        self.assertIn("expected a tire file", self.latsch("mesh", study, "--place-columns", placed, code=WRONG_INPUT))
        self.assertIn("allow more", self.latsch("mesh", study.parent / "tire.toml", "--place-columns", placed,
                                                "--unknowns", "99", code=FAILED))

    def test_a_folder_that_cannot_be_made_is_named(self):
        (self.folder / "file").write_text("no folder")
        said = self.latsch("new", self.folder / "file" / "x", "--size", "275/35R19", code=WRONG_INPUT)
        self.assertIn(f"{self.folder}/file/x: cannot be created or changed: Not a directory", said)

    def found(self, study):
        run = subprocess.run([LATSCH, "run", study, "--json"], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, DONE, run.stderr)
        return json.loads(run.stdout)["result"]

    def test_a_suspension_is_found_at_once(self):
        self.latsch("new", self.folder / "corner", "--suspension")
        study = self.folder / "corner" / "study.toml"
        self.assertIn("Everything is in order", self.latsch("check", study))
        found = self.found(study)
        self.assertLess(found["target"], 1e-3)
        assert_identifiability(self, study.parent, [one["name"] for one in found["variables"]])
        self.latsch("test", study.parent / "corner.toml", '{kind = "kinematics", from = "-30 mm", to = "30 mm", points = 5}')
        self.assertIn("exists already", self.latsch("new", self.folder / "corner", "--suspension", code=WRONG_INPUT))

    # The units of the recording are N/mm and kN s/m. Its noise of 3 N is small compared with the forces, so the fit
    # finds the values with which it was computed.
    def test_a_car_is_found_at_once_and_drives(self):
        self.latsch("new", self.folder / "car", "--car")
        study = self.folder / "car" / "study.toml"
        self.assertIn("Everything is in order", self.latsch("check", study))
        for variable, made_of in zip((found := self.found(study))["variables"], (52.5, 56.0, 3.8, 4.2)):
            self.assertAlmostEqual(variable["value"] / made_of, 1.0, delta=0.03, msg=variable["name"])
        assert_identifiability(self, study.parent, [one["name"] for one in found["variables"]])
        self.latsch("test", study.parent / "car.toml", study.parent / "kerb.toml", "--html", self.folder / "kerb.html", "-o",
                    self.folder / "kerb.csv")
        self.latsch("new", self.folder / "both", "--car", "--suspension", code=WRONG_INPUT)

    def test_the_size_of_the_inflated_tire_is_said(self):
        """Inflation changes the diameter of a passenger tire by less than 1 %, that of the soft race tire by
        about 3 %. The printed size is equal to that of the test "inflation"."""
        for size, grows in (("20.5x7.0-13", (2.0, 5.0)), ("205/55R16", (-1.0, 1.0))):
            folder = self.folder / re.sub(r"\W", "_", size)
            said = self.latsch("new", folder, "--size", size)
            found = re.search(r"the tire is ([\d.]+) mm high .* and ([\d.]+) mm wide, ([+-][\d.]+) % of the diameter of its size", said)
            self.assertTrue(found, said)
            measured = json.loads(self.latsch("test", folder / "tire.toml", '{kind = "inflation"}', "--json"))["result"]["channels"]
            radius = next(one["values"][0] for one in measured if one["name"] == "outer_radius")
            self.assertAlmostEqual(float(found[1]), 2e3 * radius, delta=0.06)
            self.assertTrue(grows[0] < float(found[3]) < grows[1], said)

    def test_sizes_that_make_no_tire(self):
        for size, said in (("275", "expected a size such as"), ("325/80R13", "there is no template near it"),
                           ("205/15R16", "there is no template near it"), ("13x2-10", "there is no template near it")):
            self.assertIn(said, self.latsch("new", self.folder / "x", "--size", size, code=WRONG_INPUT))
            self.assertFalse((self.folder / "x").exists())


if __name__ == "__main__":
    unittest.main()
