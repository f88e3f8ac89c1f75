#!/usr/bin/env python3
"""Tests cars, kerbs, posts, rigs and roads with numbers that cannot be intended: each is refused or reported by name.

   car_doors_test.py PATH/TO/latsch"""
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
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
        """Edits the car's file or one that it names, expects `check` and `test` to refuse it, and restores it."""
        file = file or self.car
        written = file.read_text()
        edit(file, *edits)
        try:
            for arguments in commands or (("check", self.car), ("test", self.car, POSTS)):
                self.assertRegex(self.latsch(*arguments, code=WRONG_INPUT), says)
        finally:
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
                ('inertia = ."25 kg m.2", "90 kg m.2", "100 kg m.2".', 'inertia = ["25 kg mm^2", "90 kg mm^2", "100 kg mm^2"]', r"chassis\.inertia\.0 is 2\.5e-05 kg m\^2"),
                ('wheel_spin = "0.23 kg m.2"', 'wheel_spin = "23 t m^2"', r"a wheel's inertia"),
                ('"0.5 m/s", "1.9 kN"', '"500 m/s", "1.9 kN"', r"a damper's rate is usually at most 8 m/s"),
                ('"0.5 m/s", "1.9 kN"', '"0.5 m/s", "1.9 MN"', r"a damper's force is usually at most 60 kN"),
                ('"-40 mm", "-12 kN"', '"-40 m", "-12 kN"', r"a spring's travel is usually at most 600 mm")):
            with self.subTest(new=new):
                self.refused(says, (old, new))

    # The message about a number of a suspension names the suspension's own file and line.
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
                 if tomllib.loads(file.read_text()).get("kind") in ("car", "suspension")]
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

    # The curve of a bump stop may be negative if its sum with the spring resists; the force of a damper may fall over
    # speed.
    def test_curves_that_resist_less_are_no_error(self):
        edit(self.car, ('"-40 mm", "-12 kN"', '"-40 mm", "1 kN"'), ('"0.5 m/s", "1.9 kN"', '"0.5 m/s", "0.5 kN"'))
        text = self.latsch("check", self.car)
        self.assertIn("front.spring.damper falls from 600 N", text)
        self.assertIn("front.spring.curve falls from 1000 N", text)

    def test_tires_that_do_not_fit(self):
        shutil.copy(STUDIES / "tires" / "passenger_205_55R16.toml", self.folder / "kerb" / "fe.toml")
        shutil.copy(STUDIES / "tire_model_comparison" / "rigid_ring.tir", self.folder / "kerb" / "large.tir")
        (self.folder / "kerb" / "deck.inp").write_text("*NODE\n")
        (self.folder / "kerb" / "plain.toml").write_text('pressure = "2 bar"\n')
        for name, says in (("plain.toml", r"front_tire is .*plain\.toml, which states neither a kind nor the section of a finite-element tire"),
                           ("deck.inp", r"front_tire is .*deck\.inp, a deck, which does not roll"),
                           ("front.toml", r'front_tire is of kind "suspension", which does not roll')):
            self.refused(says, ('front_tire = "slick.tir"', f'front_tire = "{name}"'))
        self.refused(r"front_tire: the tire FL has a radius of 316 mm, but its wheel center is drawn 235 mm above the ground",
                     ('front_tire = "slick.tir"', 'front_tire = "large.tir"'), commands=(("check", self.car),))
        self.refused(r"front_tire: the tire FL has a radius of 31\d(\.\d)? mm, but its wheel center is drawn 235 mm above the ground",
                     ('front_tire = "slick.tir"', 'front_tire = "fe.toml"'), commands=(("check", self.car),))
        self.refused(r"rear_tire_right: the tire RR has a radius of 316 mm",
                     ('rear_tire = "slick.tir"', 'rear_tire = "slick.tir"\nrear_tire_right = "large.tir"'), commands=(("check", self.car),))


class Kerbs(Doors):
    WHEEL = 612.5  # mm, y of the center planes of the left wheels
    KERB = ('[kerb]\nkind = "kerb"\nshape = "sine"\npitch = "800 mm"\nwidth = "800 mm"\nheight = "25 mm"\n'
            'count = 6\nstart = ["0 m", "0.5 m"]\n')

    def setUp(self):
        super().setUp()
        self.with_kerb_study()
        self.test = self.folder / "drive.toml"
        self.write()

    def write(self, *changes, keys=""):
        text = f'kind = "kerb"\nspeed = "60 m/s"\nrun_in = "0.02 s"\nduration = "0.06 s"\n{keys}' + self.KERB
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.test.write_text(text)

    def said(self, *changes, keys="", code=DONE):
        self.write(*changes, keys=keys)
        return self.latsch("test", self.car, self.test, "-o", self.folder / "out.csv", code=code)

    def test_a_kerb_that_can_be_driven_over_is_not_told_of(self):
        self.assertNotRegex(self.said(), "meets|sample_step is|drives over")

    # A long hill of the same height can be driven over, and a wheel does not follow a narrow slot.
    def test_kerbs_that_no_car_drives_over(self):
        for height in ("200 mm", "500 mm", "-200 mm", "1.9 m"):
            text = self.said(('"25 mm"', f'"{height}"'), code=WRONG_INPUT)
            self.assertRegex(text, r"no car drives over this road: at x = .* wheel [FR][LR] would have to rise .* section of its tire is 108 mm")
        self.assertIn("expected -2 m to 2 m", self.said(('"25 mm"', '"50 m"'), code=WRONG_INPUT))
        self.assertNotIn("drives over", self.said(('"25 mm"', '"200 mm"'), ('"800 mm"\nwidth', '"20 m"\nwidth')))
        slot = ('shape = "sine"', 'shape = "block"\nlength = "20 mm"')
        self.assertNotIn("drives over", self.said(slot, ('"25 mm"', '"-200 mm"')))
        car = self.written
        for axle in ("front", "rear"):  # a tire whose file states no rim radius
            car = car.replace(f'{axle}_tire = "slick.tir"\n', "")
            car += f'\n[{axle}.spring_tire]\nradius = "235 mm"\nstiffness = "117 N/mm"\n'
        self.car.write_text(car)
        self.assertIn("no section of such a tire is more than 141 mm", self.said(('"25 mm"', '"500 mm"'), code=WRONG_INPUT))

    def test_steps_that_jump_over_the_shape(self):
        for changes, keys, says in (
                ((), 'step = "2 ms"\nsample_step = "2 ms"\n', r"step moves the tire 120 mm at 216 km/h, expected at most 20 mm"),
                ((('"800 mm"\nwidth', '"40 mm"\nwidth'),), "", r"step moves the car 12 mm at 60 m/s, but a pitch of the kerb is 40 mm long"),
                ((('shape = "sine"', 'shape = "block"\nlength = "8 mm"'),), "", r"step moves the car 12 mm .* a bar of the kerb is 8 mm long"),
                ((), 'sample_step = "10 ms"\n', r"sample_step moves the car 600 mm .* a pitch of the kerb is 800 mm long: expected at most 3\.33 ms"),
                ((), 'sample_step = "0.05 s"\n', r"sample_step leaves less than two samples")):
            with self.subTest(keys=keys):
                self.assertRegex(self.said(*changes, keys=keys, code=WRONG_INPUT), says)
        self.assertIn("the pitch of a kerb", self.said(('"800 mm"\nwidth', '"1 mm"\nwidth'), ("60 m/s", "0.5 m/s"), keys='sample_step = "0.2 ms"\n', code=WRONG_INPUT))
        self.assertIn("the record holds frequencies to", self.said(keys='sample_step = "3 ms"\n'))

    # At a speed at which the usual time step would be too long, the program uses a shorter one.
    def test_a_high_speed_has_a_usual_step_that_it_may_have(self):
        self.assertIn("wrote", self.said(("60 m/s", "130 m/s")))

    def test_a_kerb_that_no_tire_meets_is_told(self):
        for changes in ((('["0 m", "0.5 m"]', '["0 m", "50 m"]'),), (('["0 m", "0.5 m"]', '["-500 m", "0.5 m"]'),),
                        (('["0 m", "0.5 m"]', '["20 m", "0.5 m"]'),), (('width = "800 mm"', 'width = "30 mm"'), ('"0.5 m"]', '"0.45 m"]'))):
            self.assertRegex(self.said(*changes), r"no tire meets the kerb, so the record is that of a level road: the wheels roll from x = -")
        self.assertIn("the car stands: its speed is 0", self.said(("60 m/s", "0 m/s")))
        self.assertIn("expected 1000 um to", self.said(('width = "800 mm"', 'width = "1 um"'), code=WRONG_INPUT))

    # The right edge of the kerb is 30 or 60 mm beside the contact point of the left wheels, whose tread is 180 mm
    # wide.
    def test_a_kerb_beside_the_contact_point_is_told(self):
        for beside in (30, 60):
            said = self.said(('width = "800 mm"', 'width = "60 mm"'), ('"0.5 m"]', f'"{self.WHEEL + beside:.1f} mm"]'))
            self.assertIn("no tire meets the kerb", said)
            found = re.search(r"the contact point of tire [FR]L passes ([\d.]+) mm beside something 25 mm high, on which a tread 180 mm wide "
                              r"would stand: this tire feels the line below its contact point alone", said)
            self.assertIsNotNone(found, said)
            self.assertAlmostEqual(float(found[1]), beside, delta=1.0)
        far = self.said(('width = "800 mm"', 'width = "60 mm"'), ('"0.5 m"]', f'"{self.WHEEL + 300:.1f} mm"]'))
        self.assertNotIn("beside something", far)
        # the center planes of the wheels are on the kerb, far from its edges
        self.assertNotIn("beside something", self.said())

    def test_it_stands_on_every_line(self):
        for line in ("10 m", "20 m", "-50 m", "50 m"):
            self.said(('start = ["0 m", "0.5 m"]', 'start = ["0 m", "60 m"]'), keys=f'line = "{line}"\n')


class Posts(Doors):
    def setUp(self):
        super().setUp()
        self.with_kerb_study()

    def refused_test(self, keys, says):
        text = self.latsch("test", self.car, '{kind = "four_post", ' + keys + "}", code=WRONG_INPUT)
        self.assertRegex(text, says)

    def test_frequencies_beyond_the_samples(self):
        self.refused_test('to = "3000 Hz", step = "0.5 ms"', r"to reaches 3000 Hz, of whose period a sample every 1 ms sees 0\.333; expected 12 at least")
        self.refused_test('to = "100 Hz"', r"sees 10; expected 12 at least: frequencies to 83\.33 Hz, or a sample_step of at most 0\.833 ms")
        self.refused_test('sample_step = "50 ms", spectra = true', r"to reaches 30 Hz")
        self.refused_test('sample_step = "100 ms"', r"to reaches 30 Hz")  # the limit also holds without spectra

    def test_spectra_without_spectra(self):
        for key in ('segment = "1 s"', 'band = ["1 Hz", "20 Hz"]'):
            self.refused_test(key, "belongs to the spectra, which are not recorded: expected spectra = true")

    def test_a_sweep_too_short_for_its_lowest_frequency(self):
        self.refused_test('duration = "0.1 s"', r"duration is 0\.1 s, which holds 0\.05 periods of the lowest frequency, 0\.5 Hz")
        self.refused_test('duration = "1.5 s"', r"expected one at least: 2 s or more")

    def test_motions_that_no_post_makes(self):
        self.refused_test('amplitude = "3 m"', r"the amplitude of a post is usually 0\.01 to 100 mm")
        self.refused_test('velocity = "30 m/s"', r"the velocity of a post")

    # The posts move at 25 Hz and are recorded every 25 ms, so spectra would show the motion at 15 Hz (aliasing).
    def test_recorded_posts_that_move_faster_than_the_samples(self):
        rows = ["time [s],post_FL [m],post_FR [m],post_RL [m],post_RR [m]"]
        for i in range(2001):
            h = 1e-4 * math.sin(2.0 * math.pi * 25.0 * 2e-3 * i) + 1e-3 * math.sin(2.0 * math.pi * 3.0 * 2e-3 * i)
            rows.append(f"{2e-3 * i:.3f}" + f",{h:.9f}" * 4)
        (self.folder / "posts.csv").write_text("\n".join(rows) + "\n")
        test = self.folder / "posts.toml"
        keys = 'kind = "four_post"\nposts = "posts.csv"\nstep = "0.5 ms"\n'
        test.write_text(keys + 'sample_step = "25 ms"\nspectra = true\nsegment = "2 s"\n')
        self.assertRegex(self.latsch("test", self.car, test, code=WRONG_INPUT),
                         r"sample_step is 25 ms, which holds frequencies to 20 Hz, but 4\d % of the power of the recorded posts' velocity in heave lies above")
        test.write_text(keys + 'sample_step = "10 ms"\nspectra = true\nsegment = "2 s"\n')
        self.latsch("test", self.car, test)
        test.write_text(keys + 'sample_step = "10 ms"\nspectra = true\nsegment = "2 s"\nband = ["1 Hz", "60 Hz"]\n')
        self.assertRegex(self.latsch("test", self.car, test, code=WRONG_INPUT), r"band (ends at|is 1 to) 60 Hz")


class Rigs(Doors):
    FRONT = STUDIES / "kerb" / "front.toml"

    def test_loads_and_ways_that_no_rig_makes(self):
        kinematics = '{kind = "kinematics", travel = ["-10 mm", "10 mm"], '
        for test, says in (
                ('{kind = "kc", Fy = "-400 kN"}', r'Fy is "-400 kN", but a load on a wheel is usually at most 60 kN; "-400 N" would be usual'),
                ('{kind = "kc", Mz = ["0 N m", "400 kN m"]}', "a moment on a wheel is usually at most 20 kN m"),
                (kinematics + 'rack = ["-10 mm", "10 mm"], rack_per_turn = "85 m"}', r'rack_per_turn is "85 m", .*"85 mm" would be usual'),
                (kinematics + 'axle = "front", wheelbase = "1.55 m", cg_height = "30 m", brake_share = 0.6}', "a center of mass is usually 0.1 to 2.5 m"),
                (kinematics + 'rack = ["-10 mm", "10 mm"], wheelbase = "1550 m"}', "a wheelbase is usually 0.8 to 8 m"),
                ('{kind = "kinematics", travel = "30 m"}', "a wheel's travel is usually at most 250 mm"),
                ('{kind = "kinematics", rack = "5 m"}', "a rack's travel is usually at most 150 mm")):
            with self.subTest(test=test):
                self.assertRegex(self.latsch("test", self.FRONT, test, code=WRONG_INPUT), says)

    def test_a_long_travel_may_be_meant(self):
        text = self.latsch("test", self.FRONT, '{kind = "kinematics", travel = ["0 mm", "20 mm"]}')
        self.assertNotIn("usually", text)
        run = subprocess.run([LATSCH, "test", self.FRONT, '{kind = "kinematics", travel = ["0 mm", "300 mm"]}'], capture_output=True, text=True)
        self.assertIn("warning: ", run.stderr)
        self.assertIn("a wheel's travel is usually at most 250 mm", run.stderr)


class Roads(Doors):
    DRUM = 'kind = "drum"\ndiameter = "2.5 m"\nspeed = "60 km/h"\ncleats = 1\nheight = "20 mm"\nlength = "25 mm"\n'

    def road(self, *changes, points="x [m],y [m]\n0,0\n1,0\n", code=DONE, options=()):
        text = self.DRUM
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.folder / "road.toml").write_text(text)
        (self.folder / "points.csv").write_text(points)
        return self.latsch("road", self.folder / "road.toml", self.folder / "points.csv", *options, code=code)

    def test_cleats_that_do_not_fit_the_drum(self):
        self.assertRegex(self.road(('"25 mm"', '"9 m"'), code=WRONG_INPUT), r"length does not fit the drum: the cleat covers 9 m of a drum that is 7\.854 m around")
        hundred = (("cleats = 1", "cleats = 100"), ('"25 mm"', '"100 mm"'))
        self.assertRegex(self.road(*hundred, code=WRONG_INPUT), r"cleats does not fit the drum: the cleats overlap: one covers 100 mm .* 78\.54 mm behind its begin")
        self.road(hundred[0], ('"25 mm"', '"70 mm"'))
        oblique = ('"25 mm"\n', '"70 mm"\nangle = "60 deg"\n')  # at this angle the bar covers twice the length
        self.assertIn("one covers 140 mm", self.road(hundred[0], oblique, code=WRONG_INPUT))
        self.assertIn("expected -2 m to 2 m", self.road(('kind = "drum"\ndiameter = "2.5 m"\nspeed = "60 km/h"\ncleats = 1', 'kind = "cleat"'),
                                                         ('"20 mm"', '"20 m"'), code=WRONG_INPUT))
        self.assertIn("makes a slope of", self.road((self.DRUM, 'kind = "wave"\namplitude = "10 m"\nwave_length = "1 mm"\n'), code=WRONG_INPUT))

    def test_cleats_on_an_adams_drum_overlap_as_well(self):
        rdf = ("[UNITS]\nLENGTH = 'mm'\nANGLE = 'degree'\nFORCE = 'newton'\nMASS = 'kg'\nTIME = 'second'\n"
               "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'drum'\n[PARAMETERS]\nMU = 1.0\nDIAMETER = -2500\nV = 0\nNUMBER_CLEATS = 100\n"
               "CLEAT_STARTING_ANGLE = 180\nMU_FACTOR_CLEAT = 1\nCLEAT_HEIGHT = 20\nCLEAT_LENGTH = 100\nCLEAT_BEVEL_EDGE_LENGTH = 0\nCLEAT_DIRECTION = 0\n")
        (self.folder / "drum.rdf").write_text(rdf)
        (self.folder / "points.csv").write_text("x [m],y [m]\n0,0\n")
        self.assertIn("the cleats overlap", self.latsch("road", self.folder / "drum.rdf", self.folder / "points.csv", code=WRONG_INPUT))

    def test_a_drum_test_refuses_a_cleat_around_its_drum(self):
        test = ('{kind = "drum_cleat", speed = "10 km/h", load = "1 kN", drum_diameter = "0.3 m", cleat = {height = "5 mm", length = "0.99 m"}}')
        self.assertIn("does not fit the drum", self.latsch("test", STUDIES / "kerb" / "slick.tir", test, code=WRONG_INPUT))

    def test_points_beside_a_drum_are_told_and_have_no_height(self):
        text = self.road(points="x [m],y [m]\n0,0\n1.2,0\n2,0.5\n1000,0\n")
        self.assertIn("3 of 4 points lie beyond the data of the road, the first at x = 1.2 m, y = 0 m: a wheel meets a drum with a "
                      "radius of 1.25 m only within 1.188 m", text)
        self.assertIn("2 of them have no height, because they are beside the drum", text)
        self.assertNotIn("-3039", text)
        self.assertNotIn("beyond", self.road())

    def test_a_time_beside_a_column_of_times(self):
        text = self.road(points="x [m],y [m],time [s]\n0,0,0\n", options=("--time", "3 s"), code=WRONG_INPUT)
        self.assertIn("has a column time, beside which --time has no effect", text)

    def test_a_drum_record_that_misses_its_cleat(self):
        drum = ('{kind = "drum_cleat", speed = "60 km/h", load = "4 kN", drum_diameter = "2.5 m", run_in = "0.05 s", lead = "0.02 s", '
                'duration = "0.1 s", step = "0.5 ms", cleat = {height = "10 mm", length = "20 mm"}, %s}')
        tire = STUDIES / "tire_model_comparison" / "rigid_ring.tir"
        run = lambda keys, code=DONE: self.latsch("test", tire, drum % keys, "--kind", "rigid_ring", "-o", self.folder / "o.csv", code=code)
        self.assertIn("the record holds frequencies to 50 Hz", run('sample_step = "10 ms"'))
        self.assertIn("leaves less than two samples", run('sample_step = "80 ms"', code=WRONG_INPUT))
        self.assertNotIn("the record holds", run('sample_step = "1 ms"'))
        fine = drum.replace('"20 mm"', '"5 mm"') % 'sample_step = "1 ms"'
        self.assertIn("over a cleat of 5 mm at once", self.latsch("test", tire, fine, "--kind", "rigid_ring", code=WRONG_INPUT))


class Comparisons(Doors):
    TINY = """title = "tiny"
channels = ["pushrod_FL", "pushrod_FR"]
from = "0 s"
segment = "0.05 s"
[band.whole]
edges = ["20 Hz", "150 Hz"]
[reference]
title = "Track"
kind = "car"
file = "baseline.toml"
[test.k]
file = "k.toml"
[test.k.vary]
speed = ["50 m/s", "60 m/s"]
[model.b]
title = "other"
kind = "car"
file = "other.toml"
"""

    def setUp(self):
        super().setUp()
        self.with_kerb_study()
        (self.folder / "kerb" / "other.toml").write_text(self.written.replace('mass = "220 kg"', 'mass = "226 kg"'))
        (self.folder / "kerb" / "k.toml").write_text('kind = "kerb"\nspeed = "60 m/s"\nrun_in = "0.02 s"\nduration = "0.06 s"\n' + Kerbs.KERB)

    def compare(self, *changes, code=WRONG_INPUT):
        text = self.TINY
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        file = self.folder / "kerb" / "tiny.toml"
        file.write_text(text)
        return self.latsch("compare", file, code=code)

    def test_it_runs(self):
        self.assertIn("other: PSD distance to Track", self.compare(code=DONE))

    def test_what_no_record_holds(self):
        for change, says in (
                (('from = "0 s"', 'from = "0 s"\ntold = ["foo"]'), r'told has "foo", which no test records'),
                (('from = "0 s"', 'from = "0 s"\ntold = ["Fz_Fl"]'), r'told has "Fz_Fl", which no test records, did you mean "Fz_FL"'),
                (('from = "0 s"', 'from = "0 s"\ntold = ["Fz_FL", "Fz_FL"]'), r"told has a channel twice"),
                (('from = "0 s"', 'from = "-10 s"'), r"from is -10 s, but Track begins at -0\.02 s"),
                (('from = "0 s"', 'from = "10 s"'), r"fewer than 16 selected samples"),
                (('"150 Hz"', '"15000 Hz"'), r"hold nothing above 500 Hz"),
                (('"20 Hz", "150 Hz"', '"0.1 Hz", "1 Hz"'), r"has no line of the spectra"),
                (('segment = "0.05 s"', 'segment = "10 s"'), r"expected a shorter segment"),
                (('segment = "0.05 s"', 'segment = "1 ms"'), r"expected 16 samples at least"),
                (('kind = "car"\nfile = "baseline.toml"', 'kind = "car"\nfile = "baseline.toml"\n[reference.noise]\nfoo = "5 N"'),
                 r"reference\.noise\.foo is of a channel that the reference does not record"),
                (('"50 m/s", "60 m/s"', '"60 m/s", "60 m/s"'), r"speed has a value twice"),
                (('"pushrod_FL", "pushrod_FR"', '"pushrod_FL", "pushrod_FL"'), r"channels has a channel twice"),
                (('file = "other.toml"', 'file = "slick.tir"'), r"slick\.tir: is a \.tir file, which is no car"),
                (('kind = "car"\nfile = "baseline.toml"', 'kind = "car"\nfile = "baseline.toml"\nlow_pass = "600 Hz"'),
                 r"reference\.low_pass is 600 Hz, but 1000 samples a second hold nothing above 500 Hz"),
                (('[model.b]', '[bands]\nsamples = 1\n[model.b]'), r"samples is 1, which has no quantiles")):
            with self.subTest(change=change):
                self.assertRegex(self.compare(change), says)

    def test_the_noise_of_recorded_channels_may_stay_beside_recordings(self):
        reference = 'kind = "car"\nfile = "baseline.toml"'
        noise = '\nrecorded = ["speed"]\n{}[reference.noise]\nspeed = "0.05 m/s"\npushrod_FL = "50 N"'
        file = self.folder / "kerb" / "tiny.toml"
        file.write_text(self.TINY.replace(reference, reference + noise.format("")))
        self.latsch("compare", file, "--write-measurements", self.folder / "kerb" / "rec")
        self.compare((reference, reference + noise.format('recordings = "rec"\n')), code=DONE)
        unknown = noise.format('recordings = "rec"\n').replace('speed = "0.05 m/s"', 'line = "5 mm"')
        self.assertRegex(self.compare((reference, reference + unknown)), r"reference\.noise\.line is of a channel")

    def test_recordings_with_a_gap_or_a_channel_that_is_still(self):
        file = self.folder / "kerb" / "tiny.toml"
        file.write_text(self.TINY)
        self.latsch("compare", file, "--write-measurements", self.folder / "kerb" / "rec")
        measured = ('kind = "car"\nfile = "baseline.toml"', 'kind = "car"\nfile = "baseline.toml"\nrecordings = "rec"')
        self.compare(measured, code=DONE)
        record = self.folder / "kerb" / "rec" / "k-2.csv"
        whole = [line for line in record.read_text().splitlines() if not line.startswith("#")]
        record.write_text("\n".join(whole[:40] + whole[45:]) + "\n")
        self.assertRegex(self.compare(measured), r"Track is not even in time: sample 40 follows at")
        still = [whole[0]] + [",".join([row.split(",")[0], "0", *row.split(",")[2:]]) for row in whole[1:]]
        record.write_text("\n".join(still) + "\n")
        self.assertRegex(self.compare(measured), r'"pushrod_FL" of Track does not move in band\.whole')

    def test_limits_of_the_tests_are_told(self):
        kerb = self.folder / "kerb" / "k.toml"
        kerb.write_text(kerb.read_text().replace('speed = "60 m/s"', 'speed = "60 m/s"\nsample_step = "2 ms"'))
        text = self.compare(('segment = "0.05 s"', 'segment = "0.04 s"'), ('"20 Hz", ', '"25 Hz", '), code=DONE)
        self.assertRegex(text, r"other: sample_step is 2 ms, .* \(k-2\)")


if __name__ == "__main__":
    unittest.main()
