#!/usr/bin/env python3
"""Numbers of cars, kerbs, posts, rigs and roads that cannot be meant: each is refused or told by name.

    car_doors_test.py PATH/TO/latsch
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, WRONG_INPUT, edit

STUDIES = pathlib.Path(__file__).resolve().parents[4] / "studies"
POSTS = '{kind = "four_post", duration = "0.5 s", from = "5 Hz"}'


class Doors(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_doors_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout + run.stderr

    def with_kerb_study(self):
        shutil.copytree(STUDIES / "kerb", self.folder / "kerb", ignore=shutil.ignore_patterns("*.latsch", "*.html"))
        self.car = self.folder / "kerb" / "baseline.toml"
        self.written = self.car.read_text()

    def refused(self, says, *edits, file=None, commands=None):
        """Edits the car or one of its files, expects the refusal by check and test, and restores the file."""
        file = file or self.car
        written = file.read_text()
        edit(file, *edits)
        for arguments in commands or (("check", self.car), ("test", self.car, POSTS)):
            self.assertRegex(self.latsch(*arguments, code=WRONG_INPUT), says)
        file.write_text(written)


class Cars(Doors):
    def setUp(self):
        super().setUp()
        self.with_kerb_study()

    def test_numbers_that_no_car_has(self):
        for old, new, says in (
                ('mass = "220 kg"', 'mass = "220 g"', r'baseline\.toml:11: chassis\.mass is "220 g", .*"220 kg" would be usual'),
                ('wheel = "8.2 kg"', 'wheel = "8.2 g"', r"a wheel's mass is usually 0\.3 to 300 kg.*\"8\.2 kg\" would be usual"),
                ('"52.538 N/mm"', '"52.538 MN/mm"', r"front\.spring\.stiffness"),
                ('upright = "4 kg"', 'upright = "4 t"', r'"4 kg" would be usual'),
                ('inertia = ."25 kg m.2", "90', 'inertia = ["25 kg mm^2", "90', r"chassis\.inertia\.0 is 2\.5e-05 kg m\^2"),
                ('wheel_spin = "0.23 kg m.2"', 'wheel_spin = "0.23 t m^2"', r"a wheel's inertia"),
                ('"0.5 m/s", "1.9 kN"', '"500 m/s", "1.9 kN"', r"a damper's rate is usually at most 8 m/s"),
                ('"0.5 m/s", "1.9 kN"', '"0.5 m/s", "1.9 MN"', r"a damper's force is usually at most 60 kN"),
                ('"-40 mm", "-12 kN"', '"-40 m", "-12 kN"', r"a spring's travel is usually at most 600 mm")):
            with self.subTest(new=new):
                self.refused(says, (old, new))

    # A number of a suspension is named with its own file and line.
    def test_numbers_that_no_suspension_and_no_air_have(self):
        rear = self.folder / "kerb" / "rear.toml"
        self.car.write_text(self.written.replace("rear_rigid.toml", "rear.toml"))
        self.refused(r"rear\.toml:\d+: bushing\.all\.x is .*a joint's stiffness", (r'\nx = "[0-9.]+ kN/mm"', '\nx = "24 N/m"'), file=rear)
        self.refused(r"rear\.toml:\d+: bushing\.all\.damping is", (r'\ndamping = "0.1 ms"', '\ndamping = "100 s"'), file=rear)
        air = '\n[aero]\narea = "1.2 m^2"\nmap = [["0 mm", "0 mm", 1.4, 1.7]]\n'
        for old, new, says in (("1.2 m.2", "12000 m^2", "an area of air forces"), ("1.4, 1.7", "1400, 1.7", "a coefficient of downforce")):
            self.car.write_text(self.written + air)
            self.refused(says, (old, new))

    def test_what_is_unusual_and_may_be_meant_is_a_warning(self):
        edit(self.car, ('mass = "220 kg"', 'mass = "12 kg"'))
        self.assertRegex(self.latsch("check", self.car), r"warning: .*chassis\.mass is \"12 kg\", but a chassis' mass is usually 20 to")

    def test_the_shipped_cars_and_suspensions_have_usual_numbers(self):
        files = [file for file in sorted(STUDIES.glob("*/*.toml"))
                 if any(f'\nkind = "{kind}"' in "\n" + file.read_text() for kind in ("car", "suspension"))]
        self.assertGreater(len(files), 15)
        for file in files:
            self.assertNotIn("usually", self.latsch("check", file), file)

    def test_dampers_that_push_and_stops_that_pull(self):
        drives = "it drives the motion on instead of resisting it"
        for old, new, says in (
                ('"0.1 m/s", "600 N"', '"0.1 m/s", "-600 N"', r"front\.spring\.damper has -600 N at 0\.1 m/s: " + drives),
                ('"-0.5 m/s", "-1.3 kN"', '"-0.5 m/s", "1.3 kN"', r"front\.spring\.damper has 1300 N at -0\.5 m/s: " + drives),
                ('"-40 mm", "-12 kN"', '"-40 mm", "12 kN"', r"front\.spring\.curve has 1\.2e\+04 N at -0\.04 m, more than the stiffness beside it")):
            self.refused(says, (old, new))
        front = self.folder / "kerb" / "front_rigid.toml"
        written = front.read_text()
        front.write_text(written + '\n[bushing.ubj]\nrigid = false\ncurve.x = [["-1 mm", "9 kN"], ["0 mm", "0 kN"], ["1 mm", "-9 kN"]]\n'
                         'y = "9 kN/mm"\nz = "9 kN/mm"\nabout_x = "1 N m/rad"\nabout_y = "1 N m/rad"\nabout_z = "1 N m/rad"\n')
        self.assertRegex(self.latsch("check", self.car, code=WRONG_INPUT), r"curve\.x has 9000 N at -0\.001 m: " + drives)
        front.write_text(written)

    # A curve beside a spring may take from it, if the sum resists; a damper may fall in its force.
    def test_curves_that_resist_less_are_no_error(self):
        edit(self.car, ('"-40 mm", "-12 kN"', '"-40 mm", "1 kN"'), ('"0.5 m/s", "1.9 kN"', '"0.5 m/s", "0.5 kN"'))
        text = self.latsch("check", self.car)
        self.assertIn("front.spring.damper falls from 600 N", text)
        self.assertIn("front.spring.curve falls from 1000 N", text)

    def test_tires_that_do_not_fit(self):
        shutil.copy(STUDIES / "tires" / "passenger_205_55R16.toml", self.folder / "kerb" / "fe.toml")
        shutil.copy(STUDIES / "tire_model_comparison" / "rigid_ring.tir", self.folder / "kerb" / "large.tir")
        (self.folder / "kerb" / "deck.inp").write_text("*NODE\n")
        for name, says in (("fe.toml", r"front_tire is .*fe\.toml, which states no kind, as a finite-element tire, which does not roll"),
                           ("deck.inp", r"front_tire is .*deck\.inp, a deck, which does not roll"),
                           ("front.toml", r'front_tire is of kind "suspension", which does not roll')):
            self.refused(says, ('front_tire = "slick.tir"', f'front_tire = "{name}"'))
        self.refused(r"front_tire: the tire FL has a radius of 316 mm, but its wheel center is drawn 235 mm above the ground",
                     ('front_tire = "slick.tir"', 'front_tire = "large.tir"'), commands=(("check", self.car),))
        self.refused(r"rear_tire_right: the tire RR has a radius of 316 mm",
                     ('rear_tire = "slick.tir"', 'rear_tire = "slick.tir"\nrear_tire_right = "large.tir"'), commands=(("check", self.car),))


if __name__ == "__main__":
    unittest.main()
