#!/usr/bin/env python3
"""Tests a car on four posts: channels over time and frequency, post motions from a table and from a measurement, and
errors that name the faulty part.

   car_test.py PATH/TO/latsch"""
import csv
import math
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, edit

STUDIES = pathlib.Path(__file__).resolve().parents[3] / "studies"
CORNERS = ("FL", "FR", "RL", "RR")
SHORT = '{kind = "four_post", duration = "0.5 s", from = "5 Hz"}'


class Cars(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_car_"))
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("kerb", "four_post"):
            shutil.copytree(STUDIES / name, self.folder / name, ignore=shutil.ignore_patterns("*.latsch", "*.html"))
        self.car = self.folder / "kerb" / "baseline.toml"

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run.stdout + run.stderr

    def columns(self, test, car=None):
        """Returns the channels without their empty cells."""
        out = self.folder / "out.csv"
        self.latsch("test", car or self.car, test, "-o", out)
        with open(out) as file:
            table = list(csv.reader(file))
        return {name.split(" [")[0]: [float(row[i]) for row in table[1:] if row[i]] for i, name in enumerate(table[0])}


class OnRoads(Cars):
    KERB = 'kind = "kerb"\nshape = "triangle"\npitch = "800 mm"\nwidth = "2 m"\nheight = "10 mm"\ncount = 2\nstart = ["0 m", "-1 m"]\n'

    def run_on(self, road, line="", code=DONE):
        test = self.folder / "drive.toml"
        test.write_text(f'kind = "kerb"\nspeed = "30 m/s"\nrun_in = "0.04 s"\nduration = "0.07 s"\n{line}{road}')
        return self.latsch("test", self.car, test, code=code) if code else self.columns(test)

    def filed(self, name, **keys):
        return f'[road]\nfile = "{name}"\n' + "".join(f"{key} = {value}\n" for key, value in keys.items())

    # A kerb described by its shape and the same kerb in a file of triangles both have plane faces and lie below all
    # wheels. What remains is the difference between the mean height below a part of the tread in closed form and by
    # samples.
    def test_a_kerb_from_a_file_is_that_in_words(self):
        (self.folder / "kerb.toml").write_text(self.KERB)
        self.latsch("road", self.folder / "kerb.toml", "--triangles", self.folder / "kerb.rdf")
        words, filed = self.run_on("[kerb]\n" + self.KERB), self.run_on(self.filed("kerb.rdf"))
        largest = max(map(abs, words["pushrod_FL"]))
        self.assertGreater(largest, 1.5 * abs(words["pushrod_FL"][0]))
        for a, b in zip(words["pushrod_FL"], filed["pushrod_FL"]):
            self.assertAlmostEqual(a, b, delta=0.002 * largest)

    def test_a_tire_off_the_edge_is_named(self):
        self.write_grid("track.crg", "")
        self.run_on(self.filed("track.crg", start='["5 m", "0 m"]'))
        for road, line, words in ((self.filed("track.crg", start='["5 m", "1 m"]'), "", r"at its start on the road: tire FL is off .*v = 1.6"),
                                  (self.filed("track.crg", start='["18.5 m", "0 m"]'), "", r"at 0.0\d+ s tire F[LR] is off the road's edge.*u = 20\.")):
            text = self.run_on(road, line, code=FAILED)
            self.assertRegex(text, words)
            self.assertIn("beyond_edge", text)
        self.run_on(self.filed("track.crg", start='["18.5 m", "0 m"]', beyond_edge='"continue"'))
        self.write_grid("round.crg", "$ROAD_CRG_OPTS\nborder_mode_u = 3\n$\n")
        self.run_on(self.filed("round.crg", start='["18.5 m", "0 m"]'))

    # The kerb lies only below the left wheels; the right ones roll on the ground beside it, which the file contains
    # too.
    def test_a_kerb_from_a_file_has_ground_beside_it(self):
        kerb = 'kind = "kerb"\nshape = "triangle"\npitch = "800 mm"\nwidth = "800 mm"\nheight = "10 mm"\ncount = 2\nstart = ["0 m", "0.2 m"]\n'
        (self.folder / "kerb.toml").write_text(kerb)
        self.latsch("road", self.folder / "kerb.toml", "--triangles", self.folder / "kerb.rdf")
        words, filed = self.run_on("[kerb]\n" + kerb), self.run_on(self.filed("kerb.rdf"))
        for corner in CORNERS:
            a, b = words[f"pushrod_{corner}"], filed[f"pushrod_{corner}"]
            size = math.sqrt(sum(x * x for x in a) / len(a))
            self.assertLess(math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a)), 0.001 * size)

    # The car's file states the driven axle. The drag transfers the same load whichever axle is driven.
    def test_drag_starts_in_balance_and_keeps_the_speed(self):
        text = self.car.read_text()
        for drives in ("", 'drives = "front"\n', 'drives = "both"\n'):
            self.car.write_text(text + '\n[aero]\narea = "1.2 m^2"\nmap = [["0 mm", "0 mm", 1.4, 1.7]]\ndrag = 0.9\n'
                                       f'drag_height = "0.3 m"\n[driver]\nline = "0 mm"\n{drives}')
            record = self.run_on("", code=None)
            for speed in record["speed"]:
                self.assertAlmostEqual(speed, 30.0, delta=1e-3)
        self.car.write_text(text + '\n[driver]\ndrives = "left"\n')
        self.assertIn("driver.drives", self.run_on("", code=WRONG_INPUT))

    # Regression test: at 60 m/s and with aerodynamic maps of several times the weight, a car with rigid joints has an
    # equilibrium, which was once not found.
    def test_downforce_on_rigid_joints_finds_rest(self):
        text = self.car.read_text()
        for times in (1.0, 2.0, 3.0):
            self.car.write_text(text + f'\n[aero]\narea = "1.2 m^2"\nmap = [["0 mm", "0 mm", {times}, {1.2 * times}]]\n')
            test = '{kind = "kerb", speed = "60 m/s", run_in = "0.01 s", duration = "0.01 s"}'
            record = self.columns(test)
            down = 9.80665 * (220.0 + 2.0 * 2.0 * (0.8 + 1.0 + 0.4 + 0.3 + 0.4 + 4.0 + 8.2)) + 0.5 * 1.2 * 3600.0 * 1.2 * 2.2 * times
            self.assertAlmostEqual(sum(record[f"Fz_{c}"][0] for c in CORNERS), down, delta=1e-6 * down)

    # Under a load of several weights a tire has a relaxation length of 2 m and more, so it has to roll farther before the
    # maneuver starts. The loads are compared at the start and after the car has rolled on for the same time.
    def test_heavy_downforce_on_one_axle_starts_in_balance(self):
        weight = 9.80665 * (220.0 + 2.0 * 2.0 * (0.8 + 1.0 + 0.4 + 0.3 + 0.4 + 4.0 + 8.2))
        for base in ("baseline.toml", "mf_compliant.toml"):
            text = (self.folder / "kerb" / base).read_text()
            # With the last two maps, rounding errors of the rigid joints were once taken for an imbalance of the car.
            for speed, front, rear in ((20.0, 2.5, 2.5), (20.0, 0.0, 4.0), (25.0, 3.0, 0.0), (45.0, 4.0, 1.0), (25.0, 0.0, 4.0)):
                per = weight / (0.5 * 1.2 * 1.2 * speed**2)
                self.car.write_text(text + '\n[aero]\narea = "1.2 m^2"\ndensity = "1.2 kg/m^3"\nfloor = ["30 mm", "40 mm"]\ndrag = 0.9\n'
                                           f'drag_height = "0.3 m"\nmap = [["20 mm", "30 mm", {per * front}, {per * rear}]]\n')
                record = self.columns(f'{{kind = "kerb", speed = "{speed} m/s", run_in = "0.1 s", duration = "0.2 s", sample_step = "10 ms"}}')
                with self.subTest(base=base, speed=speed, front=front, rear=rear):
                    down = weight * (1.0 + front + rear)
                    loads = [sum(forces) for forces in zip(*(record[f"Fz_{c}"] for c in CORNERS))]
                    self.assertAlmostEqual(loads[0], down, delta=1e-6 * down)
                    for load in loads:
                        self.assertAlmostEqual(load, down, delta=3e-6 * down)
                    for kept in record["speed"]:
                        self.assertAlmostEqual(kept, speed, delta=1e-3)

    def test_a_car_that_the_air_makes_unstable_is_told_so(self):
        with open(self.car, "a") as file:
            file.write('\n[aero]\narea = "1.2 m^2"\ndensity = "1.2 kg/m^3"\nfloor = ["30 mm", "40 mm"]\n'
                       'map = [["10 mm", "10 mm", 6.5, 7.8], ["10 mm", "60 mm", 6.37, 6], ["60 mm", "10 mm", 5, 7.64], ["60 mm", "60 mm", 5, 6]]\n')
        words = self.latsch("test", self.car, '{kind = "kerb", speed = "60 m/s", run_in = "0.1 s", duration = "0.1 s"}', code=FAILED)
        self.assertRegex(words, r"not even a small share of the load .* grows by \d+ N with every millimeter that the floor sinks")
        self.assertNotIn("had sunk most", words)

    # With constant coefficients the downforce on a level road is q A (C_f + C_r).
    def test_air_presses_it_down(self):
        still = self.run_on("", code=None)
        with open(self.car, "a") as file:
            file.write('\n[aero]\narea = "1.5 m^2"\ndensity = "1.2 kg/m^3"\nmap = [["0 mm", "0 mm", 1.0, 1.4]]\n')
        fast, q = self.run_on("", code=None), 0.5 * 1.2 * 30.0**2
        more = {axle: sum(fast[f"Fz_{axle}{side}"][-1] - still[f"Fz_{axle}{side}"][-1] for side in "LR") for axle in "FR"}
        self.assertAlmostEqual(more["F"], q * 1.5 * 1.0, delta=0.01 * q)
        self.assertAlmostEqual(more["R"], q * 1.5 * 1.4, delta=0.01 * q)

    def test_a_floor_outside_of_its_map_is_told_with_its_share(self):
        original = self.car.read_text()
        level = '[kerb]\n' + self.KERB.replace('height = "10 mm"', 'height = "0 mm"')

        def said(front, rear, road=level, speed="30 m/s"):
            """Runs a car whose floor is 30 mm high over a map of heights in mm."""
            rows = ", ".join(f'["{f} mm", "{r} mm", 1.0, 1.2]' for f in front for r in rear)
            self.car.write_text(original + '\n[aero]\narea = "0.1 m^2"\ndensity = "1.2 kg/m^3"\n'
                                f'floor = ["30 mm", "30 mm"]\nmap = [{rows}]\n')
            test = self.folder / "drive.toml"
            test.write_text(f'kind = "kerb"\nspeed = "{speed}"\nrun_in = "0.04 s"\nduration = "0.07 s"\n{road}')
            out = self.latsch("test", self.car, test, "-o", self.folder / "out.csv")
            return " ".join(line for line in out.splitlines() if "aero.map in " in line)

        self.assertEqual(said((10, 60), (10, 60)), "")
        self.assertEqual(said((60,), (10, 60)), "")  # one height is no range
        outside = said((10, 60), (60, 90))
        self.assertIn("in 111 of 111 samples (100 % of the time)", outside)
        self.assertIn("at the rear axle", outside)
        self.assertNotIn("at the front axle", outside)
        # The chassis rises on the kerb and leaves the map for a part of the run.
        self.assertIn(" % of the time)", part := said((10, 25), (10, 60), "[kerb]\n" + self.KERB))
        self.assertNotIn("(100 %", part)
        # A car at rest has no air forces.
        self.assertEqual(said((40, 60), (60, 90), level, "0 m/s"), "")

    def test_roads_that_cannot_be(self):
        self.write_grid("track.crg", "")
        for road, words in ((self.filed("none.crg"), "none.crg"), (self.filed("track.crg", start='["1 m"]'), "expected x and y"),
                            (self.filed("track.crg", beyond_edge='"level"'), "continue"),
                            (self.filed("track.crg") + "[kerb]\n" + self.KERB, "expected one of them")):
            self.assertIn(words, self.run_on(road, code=WRONG_INPUT))

    def write_grid(self, name, options):
        """Writes a level road for u from 0 to 20 m and v from -1.5 to 1.5 m."""
        rows = "".join(f"{0.0:10.4f}{0.0:10.4f}\n" for _ in range(21))
        (self.folder / name).write_text(
            "$ROAD_CRG\nreference_line_start_u = 0\nreference_line_end_u = 20\nreference_line_increment = 1\n"
            f"long_section_v_right = -1.5\nlong_section_v_left = 1.5\nlong_section_v_increment = 3\n$\n{options}"
            "$KD_DEFINITION\n#:LRFI\nD:long section 1,m\nD:long section 2,m\n$\n$$$$\n" + rows)


class OnPosts(Cars):
    def test_forces_of_a_level_car_are_its_weight_and_alike_on_both_sides(self):
        record = self.columns(SHORT)
        weight = 9.80665 * (220.0 + 2.0 * 2.0 * (0.8 + 1.0 + 0.4 + 0.3 + 0.4 + 4.0 + 8.2))
        self.assertAlmostEqual(sum(record[f"Fz_{c}"][0] for c in CORNERS), weight, delta=1e-3 * weight)
        self.assertAlmostEqual(record["pushrod_FL"][0], record["pushrod_FR"][0], delta=0.5)
        self.assertGreater(record["pushrod_FL"][0], 0.0)  # compressed

    def test_spectra_are_added_with_their_own_lines(self):
        record = self.columns('{kind = "four_post", duration = "8 s", from = "1 Hz", to = "10 Hz", spectra = true, segment = "2 s"}')
        self.assertEqual(len(record["time"]), 8001)
        self.assertEqual(record["frequency"], [0.5 * f for f in range(2, 21)])
        self.assertTrue(all(0.0 <= c <= 1.0 + 1e-12 for c in record["coherence_hub_RR"]))
        self.assertTrue(all(abs(p) <= math.pi for p in record["phase_body_z"]))
        # Far below its resonance of 6 Hz the body moves slightly more than the posts; the acceleration is (2 pi f)^2
        # times the height.
        line = record["frequency"].index(2.0)
        self.assertAlmostEqual(record["tf_body_z"][line] / (4.0 * math.pi) ** 2, 1.0 / (1.0 - (2.0 / 6.0) ** 2), delta=0.1)

    def test_a_table_of_heights_moves_the_posts_and_warp_twists(self):
        rows = ["time [s],post_FL [mm],post_FR [mm],post_RL [mm],post_RR [mm]"]
        for i in range(501):
            h = 2.0 * math.sin(2.0 * math.pi * 3.0 * i * 1e-3) ** 3
            rows.append(f"{i * 1e-3:.3f},{h:.6f},{-h:.6f},{-h:.6f},{h:.6f}")
        (self.folder / "heights.csv").write_text("\n".join(rows) + "\n")
        (self.folder / "warp.toml").write_text('kind = "four_post"\nposts = "heights.csv"\nmode = "warp"\n')
        record = self.columns(self.folder / "warp.toml")
        self.assertAlmostEqual(max(record["post_FL"]), 2e-3, delta=1e-5)
        self.assertEqual(record["post_FL"], record["post_RR"])
        self.assertLess(max(map(abs, record["heave"])), 1e-4)
        # The columns may have usual names in any case.
        named = ["Zeit [s],POST_FL [mm],post FR [mm],Post-RL [mm],post_rr [mm]", *rows[1:]]
        (self.folder / "heights.csv").write_text("\n".join(named) + "\n")
        self.assertEqual(self.columns(self.folder / "warp.toml")["post_FL"], record["post_FL"])
        (self.folder / "heights.csv").write_text("\n".join(rows) + "\n")
        edit(self.folder / "heights.csv", (r"\n0.250,", "\n0.2504,"))
        self.assertIn("not even in time at sample 251", self.latsch("test", self.car, self.folder / "warp.toml", code=WRONG_INPUT))
        # The message names where a gap in the recorded heights is, and says if the times do not begin at 0.
        (self.folder / "heights.csv").write_text("\n".join(rows[:203] + rows[250:]) + "\n")
        said = self.latsch("test", self.car, self.folder / "warp.toml", code=WRONG_INPUT)
        self.assertIn("at sample 203: it follows 0.048 s after the sample before it, while 0.001 s are usual", said)
        later = [rows[0]] + [f"{float(row.split(',')[0]) + 100.0:.3f},{row.split(',', 1)[1]}" for row in rows[1:]]
        (self.folder / "heights.csv").write_text("\n".join(later) + "\n")
        self.assertIn("begins at 100 s", self.latsch("test", self.car, self.folder / "warp.toml"))

    def swept_posts(self, to):
        """Writes a test of 8 s in heave: a sweep from 2 Hz upward with an amplitude of 1 mm."""
        rows = ["time [s],post_FL [m],post_FR [m],post_RL [m],post_RR [m]"]
        for i in range(2001):
            t = 4e-3 * i
            f = 2.0 * (to / 2.0) ** (t / 8.0)
            h = 1e-3 * math.sin(math.pi * t / 8.0) ** 2 * math.sin(2.0 * math.pi * (f - 2.0) * 8.0 / math.log(to / 2.0))
            rows.append(f"{t:.3f}" + f",{h:.9f}" * 4)
        (self.folder / "swept.csv").write_text("\n".join(rows) + "\n")

    # At frequencies that the posts do not excite, the response is only rounding noise, so the spectra must end there.
    def test_recorded_posts_hold_the_frequencies_they_move_at_and_no_others(self):
        self.swept_posts(10.0)
        swept = self.folder / "swept.toml"
        swept.write_text('kind = "four_post"\nposts = "swept.csv"\nstep = "0.5 ms"\nspectra = true\n')
        self.assertIn("move in heave only from", self.latsch("test", self.car, swept, "-o", self.folder / "out.csv"))
        lines = self.columns(swept)["frequency"]
        self.assertGreater(lines[0], 1.0)
        self.assertLess(lines[-1], 15.0)
        swept.write_text(swept.read_text() + 'band = ["2 Hz", "25 Hz"]\n')
        self.assertIn("band is 2 to 25 Hz, but the recorded posts move in heave only from", self.latsch("test", self.car, swept, code=WRONG_INPUT))
        swept.write_text('kind = "four_post"\nposts = "swept.csv"\nmode = "roll"\nspectra = true\n')
        self.assertIn("do not move in roll", self.latsch("test", self.car, swept, code=WRONG_INPUT))

    def test_a_tire_that_leaves_its_post_is_told(self):
        test = '{kind = "four_post", duration = "2 s", from = "6 Hz", to = "15 Hz", amplitude = "9 mm", velocity = "0.5 m/s", step = "0.5 ms"}'
        page = self.folder / "page.html"
        for arguments in ((), ("--html", page)):
            text = self.latsch("test", self.car, test, "-o", self.folder / "out.csv", *arguments)
            self.assertRegex(text, "tires .*FL.* left their posts, first after [0-9.]+ s \\([0-9.]+ Hz\\)")
        self.assertIn("left their posts", page.read_text())
        self.assertNotIn("left their posts", self.latsch("test", self.car, SHORT, "-o", self.folder / "out.csv"))

    def test_a_study_moves_its_posts_as_they_were_measured(self):
        text = self.latsch("check", self.folder / "four_post" / "study.toml")
        self.assertNotIn("error", text.lower())
        edit(self.folder / "four_post" / "study.toml", (r'\{from = "measurement.sweep"\}', '{from = "measurement.swept"}'))
        self.assertIn("measurement.swept", self.latsch("check", self.folder / "four_post" / "study.toml", code=WRONG_INPUT))

    def test_a_page_shows_histories_and_responses(self):
        page = self.folder / "page.html"
        self.latsch("test", self.car, SHORT, "--html", page, "-o", self.folder / "out.csv")
        for title in ("Push-rods by posts", "Density of the push-rods", "Coherence of the push-rods", "Springs"):
            self.assertIn(title, page.read_text())


class Refused(Cars):
    def complaint(self, *edits, code=WRONG_INPUT, file=None, test=SHORT):
        edit(file or self.car, *edits)
        return self.latsch("test", self.car, test, "-o", self.folder / "out.csv", code=code)

    def test_parts_that_are_missing(self):
        self.assertIn("front_tire is missing", self.complaint(('front_tire = "slick.tir"\n', "")))

    def test_files_that_are_missing(self):
        text = self.complaint(('front_suspension = "front_rigid.toml"', 'front_suspension = "fornt.toml"'))
        self.assertIn("baseline.toml:5: front_suspension is not a file", text)

    def test_a_tire_that_does_not_roll(self):
        self.assertIn("front_tire is of kind \"suspension\", which does not roll",
                      self.complaint(('front_tire = "slick.tir"', 'front_tire = "front_rigid.toml"')))

    def test_bodies_without_mass(self):
        self.assertIn("front.mass.pushrod is missing", self.complaint(('pushrod = "0.4 kg"\n', "")))

    def test_a_chassis_without_mass(self):
        self.assertIn('chassis.mass is "0 kg", expected more than 0 kg', self.complaint(('mass = "220 kg"', 'mass = "0 kg"')))

    def test_an_inertia_of_no_body(self):
        self.assertIn("the inertia of the chassis is none of a body", self.complaint(('"100 kg m.2"', '"1000 kg m^2"')))

    def test_millimeters_as_meters(self):
        text = self.complaint((' mm"', ' m"'), file=self.folder / "kerb" / "front_rigid.toml")
        self.assertIn("uca_front is more than 50 m from the origin: are its numbers millimeters?", text)

    def test_a_center_of_mass_in_millimeters(self):
        text = self.complaint((r'center = .*', 'center = ["750 m", "0 m", "280 m"]'))
        self.assertIn("the center of mass of the chassis, x = 750 m, is not between the axles", text)

    def test_a_height_of_the_center_of_mass_in_millimeters(self):
        text = self.complaint((r'center = .*', 'center = ["0.75 m", "0 m", "280 m"]'))
        self.assertIn("the center of mass of the chassis, z = 280 m, is higher", text)

    def test_front_and_rear_swapped(self):
        text = self.complaint(('front_suspension = ".*"', 'front_suspension = "rear_rigid.toml"'),
                              ('rear_suspension = ".*"', 'rear_suspension = "front_rigid.toml"'))
        self.assertIn("the front axle is not in front of the rear one", text)

    def test_a_damper_that_does_not_rise_in_x(self):
        self.assertIn("front.spring.damper does not rise in x: point 3 has -0.03 behind 0.2",
                      self.complaint((r'\["-0.1 m/s", "-450 N"\]', '["0.2 m/s", "-450 N"]')))

    def test_no_spring(self):
        self.assertIn("front.spring is missing", self.complaint((r"\[front.spring\](\n.+)+\n", "")))

    def test_a_damper_alone_carries_nothing(self):
        text = self.complaint(('stiffness = "52.538 N/mm"\n', ""), code=FAILED)
        self.assertRegex(text, "the spring unit FL carries .* at rest with a stiffness of 0 N/m")

    def test_newtons_by_meter_as_by_millimeter(self):
        text = self.complaint(('"52.538 N/mm"', '"52.538 N/m"'), code=FAILED)
        self.assertRegex(text, "the spring unit FL carries .* more than ten times its length of 182.5 mm")

    def test_a_locked_car_needs_no_spring_and_bears_one(self):
        edit(self.car, (r"\[front\]\n", "[front]\nlocked = true\n"))
        with_spring = self.columns(SHORT)
        edit(self.car, (r"\[front.spring\](\n.+)+\n", ""), ('rocker = "0.4 kg"\n', ""))
        self.assertIn("rear.mass.rocker is missing", self.latsch("test", self.car, SHORT, code=WRONG_INPUT))
        edit(self.car, ('pushrod = "0.4 kg"\n', 'pushrod = "0.4 kg"\nrocker = "0.4 kg"\n'))
        self.assertEqual(self.columns(SHORT), with_spring)
        self.assertEqual(set(with_spring["spring_FL"]), {0.0})

    def test_a_chassis_that_twists_needs_a_stiffness(self):
        rigid = self.columns(SHORT)
        self.assertIn("chassis.torsion", self.complaint((r"\[chassis\]", '[chassis]\ntorsion = "0 kN m/deg"')))
        edit(self.car, ('torsion = "0 kN m/deg"', 'torsion = "0.2 kN m/deg"'))
        twisting = self.columns(SHORT)
        self.assertNotEqual(twisting["pushrod_FL"], rigid["pushrod_FL"])

    def test_a_wheel_that_its_tire_does_not_fit(self):
        text = self.complaint((r'"235.000 mm"', '"335.000 mm"'), code=FAILED, file=self.folder / "kerb" / "front_rigid.toml")
        self.assertIn("the tire FL has a radius of 235 mm, but its wheel center is drawn 335 mm above", text)

    def test_a_load_beyond_what_it_bears(self):
        text = self.complaint(('mass = "220 kg"', 'mass = "220 t"'), code=FAILED)
        self.assertRegex(text, "the car does not stand under its weight of 2.158e.06 N: .* is pressed by more than its section")

    def test_air_that_cannot_be(self):
        rows = '["20 mm", "30 mm", 1.4, 1.7], ["40 mm", "30 mm", 1.2, 1.6], ["20 mm", "50 mm", 1.5, 1.8]'
        for keys, words in ((f'flor = ["1 mm", "2 mm"]\nmap = [{rows}, ["40 mm", "50 mm", 1, 1]]', 'unknown key "aero.flor", did you mean "floor"?'),
                            (f"map = [{rows}]", "aero.map has no row of the heights 0.04 m and 0.05 m"),
                            (f'map = [{rows}, ["40 mm", "50 mm", 1, 1]]', "floor is missing"),
                            ("map = []", "aero.map"), ('floor = ["1 mm"]\nmap = [["0 mm", "0 mm", 1, 1]]', "aero.floor expected two values")):
            original = self.car.read_text()
            self.car.write_text(original + f'\n[aero]\narea = "1.2 m^2"\n{keys}\n')
            self.assertIn(words, self.latsch("test", self.car, SHORT, code=WRONG_INPUT))
            self.car.write_text(original)

    # Every model file of the studies passes `latsch check` by itself: cars, suspensions, rings, .tir.
    def test_check_takes_every_model_file(self):
        for file in ("kerb/baseline.toml", "kerb/front_rigid.toml", "kerb/slick_ring.toml", "kerb/slick.tir", "tires/passenger_205_55R16.toml"):
            path = STUDIES / file
            text = self.latsch("check", path)
            self.assertIn("Numbers a study may vary", text, file)
            self.assertIn("Everything is in order", text, file)
        self.assertIn("mirrored on the right", self.latsch("check", STUDIES / "kerb/baseline.toml"))
        broken = self.folder / "kerb" / "broken.toml"
        broken.write_text(self.car.read_text().replace("[front]\n", "[front]\ncambr = \"1 deg\"\n", 1))
        self.assertIn("front.cambr", self.latsch("check", broken, code=WRONG_INPUT))

    # A tire that does not state its side is assumed to be a left one, and a message says so where the tire is used.
    def test_a_tire_without_a_side_is_told_of(self):
        tire = self.folder / "kerb" / "slick.tir"
        for arguments in (("check", self.car), ("check", tire), ("test", self.car, SHORT)):
            self.assertNotIn("TYRESIDE", self.latsch(*arguments))
        tire.write_text(tire.read_text().replace("TYRESIDE = 'LEFT'\n", ""))
        for arguments in (("check", self.car), ("check", tire), ("test", self.car, SHORT),
                          ("export", self.car, "--fmu", "3.0", "-o", self.folder / "car.fmu")):
            self.assertIn("states no TYRESIDE", self.latsch(*arguments))

    def test_keys_that_are_unknown(self):
        self.assertIn('unknown key "chassis.mas", did you mean "mass"?', self.complaint((r"\[chassis\]", '[chassis]\nmas = "3 kg"')))

    def test_spectra_that_cannot_be(self):
        for test, words in (('{kind = "four_post", duration = "1 s", segment = "2 s"}', "longer than the record"),
                            ('{kind = "four_post", duration = "1 s", band = ["9 Hz", "3 Hz"]}', "a lower and a higher"),
                            ('{kind = "four_post", duration = "1 s", band = ["3.2 Hz", "3.4 Hz"]}', "holds no line"),
                            ('{kind = "four_post", spectra = true, band = ["0.25 Hz", "20 Hz"]}', "the sweep goes from 0.5 to 30 Hz"),
                            ('{kind = "four_post", spectra = true, duration = "3 s", from = "0.5 Hz"}', "holds no two periods below 0.6667 Hz")):
            self.assertIn(words, self.latsch("test", self.car, test, code=WRONG_INPUT))


if __name__ == "__main__":
    unittest.main()
