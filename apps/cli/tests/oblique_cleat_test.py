#!/usr/bin/env python3
"""Tests tires on an oblique bar: effects that a model neglects are reported with the result, and a flexible ring
whose cross sections bend loses force as the bar turns, while one with rigid cross sections gains force.

   oblique_cleat_test.py PATH/TO/latsch"""
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, LATSCH

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"
STRAIGHT = STUDIES / "ring_tires" / "passenger_205_55R16.toml"
RIGID = STUDIES / "tire_model_comparison" / "rigid_ring.tir"
FE_TIRE = STUDIES / "tires" / "passenger_205_55R16.toml"
LIMIT = "sections of this flexible ring stay straight across"


def bar(degrees):
    return ('{kind = "static_stiffness", deflections = ["25 mm"], '
            f'cleat = {{height = "10 mm", length = "30 mm", angle = "{degrees} deg"}}}}')


class OnAnObliqueBar(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_oblique_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def stands(self, tire, degrees, *more):
        """Returns the force in N, and the warnings."""
        run = subprocess.run([LATSCH, "test", str(tire), bar(degrees), "--json", *more], capture_output=True, text=True)
        self.assertEqual(run.returncode, DONE, run.stdout + run.stderr)
        answer = json.loads(run.stdout)
        channels = {one["name"]: one["values"] for one in answer["result"]["channels"]}
        return channels["force"][0], " ".join(map(str, answer["warnings"]))

    def bending(self):
        tire = self.folder / "bending.toml"
        tire.write_text(STRAIGHT.read_text().replace('pressure_width = "80 mm"',
                                                     'pressure_width = "80 mm"\nbending_across = "5 N m"'))
        return tire

    # The finite-element tire loses an eighth of its force if the bar turns from 45 degrees to along the road.
    def test_sections_that_bend_lose_force_as_the_finite_element_tire_does(self):
        def falls(tire):
            return self.stands(tire, 90)[0] / self.stands(tire, 45)[0]
        self.assertLess(falls(FE_TIRE), 0.92)
        self.assertLess(falls(self.bending()), 0.95)
        self.assertGreater(falls(STRAIGHT), 1.02)

    def test_straight_sections_are_told_on_the_terminal_in_json_and_on_the_page(self):
        self.assertIn(LIMIT, self.stands(STRAIGHT, 30)[1])
        page = self.folder / "page.html"
        run = subprocess.run([LATSCH, "test", str(STRAIGHT), bar(-30), "--html", str(page), "-o", str(self.folder / "out.csv")],
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertIn(LIMIT, run.stdout + run.stderr)
        self.assertIn(LIMIT, page.read_text())

    def test_a_straight_bar_and_sections_that_bend_are_told_nothing(self):
        self.assertNotIn(LIMIT, self.stands(STRAIGHT, 0)[1])
        self.assertNotIn(LIMIT, self.stands(self.bending(), 30)[1])

    def test_a_rigid_ring_of_one_track_is_told(self):
        tire = self.folder / "one.tir"
        text = RIGID.read_text().splitlines()
        text = [line for line in text if not line.startswith("ELLIPS_NWIDTH")]
        at = next(i for i, line in enumerate(text) if line.startswith("ELLIPS_SHIFT"))
        tire.write_text("\n".join(text[:at] + ["ELLIPS_NWIDTH            = 1"] + text[at:]) + "\n")
        self.assertIn("senses the road along one line", self.stands(tire, 30, "--kind", "rigid_ring")[1])
        self.assertNotIn("along one line", self.stands(RIGID, 30, "--kind", "rigid_ring")[1])

    def test_a_drum_with_an_oblique_cleat_tells_it_too(self):
        drum = ('{kind = "drum_cleat", speed = "20 km/h", load = "3 kN", drum_diameter = "2.5 m", duration = "0.1 s", '
                'lead = "0.04 s", cleat = {height = "10 mm", length = "30 mm", angle = "30 deg"}}')
        run = subprocess.run([LATSCH, "test", str(STRAIGHT), drum, "-o", str(self.folder / "out.csv")], capture_output=True, text=True)
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertIn(LIMIT, run.stdout + run.stderr)

    def test_a_study_says_it_before_it_runs(self):
        """Checks the warning in check, at the start of run and in JSON: one sentence for all tests that it concerns,
        and none for a straight cleat."""
        study = self.folder / "study.toml"
        text = f"""model = "{STRAIGHT}"
test.straight = {bar(0)}
test.oblique = {bar(30)}
test.more = {bar(-20)}
[variable.mass]
path = "belt.mass"
lower = "5 kg"
upper = "15 kg"
initial = "9 kg"
"""
        for name in ("straight", "oblique", "more"):
            text += f'[experiment.{name}]\nkind = "values"\nchannel = "{name}/force"\nvalues = ["3 kN"]\n'
        study.write_text(text + "[optimizer]\nmax_steps = 1\n[run]\nintervals = false\nworkers = 1\n")
        for verb in ("check", "run"):
            with self.subTest(verb):
                run = subprocess.run([LATSCH, verb, study, "--json"], capture_output=True, text=True, timeout=300)
                told = [one["message"] for one in json.loads(run.stdout)["warnings"] if LIMIT in one["message"]]
                self.assertEqual(len(told), 1, run.stdout + run.stderr)
                self.assertTrue(told[0].startswith("test oblique, test more: "), told)
        study.write_text((study.read_text()).replace(f'model = "{STRAIGHT}"', f'model = "{self.bending()}"'))
        run = subprocess.run([LATSCH, "check", study], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, DONE, run.stderr)
        self.assertNotIn(LIMIT, run.stdout + run.stderr)


class OverAKerb(unittest.TestCase):
    """Checks a car on flexible rings: if a wheel is on the edge of a kerb, the obstacle is below a part of its width.
    """

    def warned(self, line):
        """Returns the warning if the car's center line is at `line`, m; the kerb, 1 m wide, begins 0.4 m to its left.
        """
        kerb = ('{kind = "kerb", speed = "40 m/s", run_in = "0.02 s", duration = "0.02 s", line = "%g m", '
                'kerb = {kind = "kerb", shape = "sine", pitch = "800 mm", width = "1 m", height = "5 mm", count = 2, '
                'start = ["0 m", "0.4 m"]}}' % line)
        run = subprocess.run([LATSCH, "test", STUDIES / "kerb" / "track.toml", kerb, "--json"], capture_output=True, text=True,
                             timeout=300)
        self.assertEqual(run.returncode, DONE, run.stdout + run.stderr)
        return " ".join(one["message"] for one in json.loads(run.stdout)["warnings"])

    def test_a_wheel_on_its_edge_is_told_of_and_a_wheel_amid_it_is_not(self):
        self.assertNotIn("sections of this flexible ring stay straight", self.warned(0.0))
        self.assertIn("sections of this flexible ring stay straight", self.warned(-0.2))


if __name__ == "__main__":
    unittest.main()
