#!/usr/bin/env python3
"""Tests a finite-element tire that rotates: modes that travel with and against the rotation, growth, standing waves,
a rim that moves.

   spinning_tire_test.py PATH/TO/latsch"""
import json
import math
import pathlib
import re
import unittest

from cli_testing import FAILED, WRONG_INPUT, Coarse

RIM = """
[rim]
mass = "9 kg"
inertia_spin = "0.25 kg m^2"
inertia_diameter = "0.18 kg m^2"
"""


class RotatingTire(Coarse):
    def channels(self, test, tire="tire.toml"):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / tire, test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def refused(self, test, *parts, tire="tire.toml"):
        said = self.latsch("test", self.folder / tire, test, code=WRONG_INPUT)
        for part in parts:
            self.assertIn(part, said)

    def with_rim(self, rim=RIM):
        text = (self.folder / "tire.toml").read_text()
        (self.folder / "with_rim.toml").write_text(text + rim)
        return "with_rim.toml"

    def with_keys(self, **keys):
        """Writes a tire with these lines in tables: rubber_matrix = "loss_factor = 0.1"."""
        text = (self.folder / "tire.toml").read_text()
        for table, line in keys.items():
            head = "[" + table.replace("__", ".") + "]\n"
            self.assertIn(head, text)
            text = text.replace(head, head + line + "\n")
        (self.folder / "lossy.toml").write_text(text)
        return "lossy.toml"

    def tables(self, kind):
        return [line.strip()[1:-1] for line in (self.folder / "tire.toml").read_text().splitlines()
                if line.startswith("[" + kind + ".")]


class Damped(RotatingTire):
    def lossy(self):
        return self.with_keys(**{table.replace(".", "__"): "loss_factor = 0.15" for table in self.tables("rubber")})

    def test_rubber_damps_and_stiffens_the_modes_of_a_standing_and_an_unloaded_tire(self):
        lossy = self.lossy()
        for load in ("", ', deflection = "8 mm"'):
            relaxed = self.channels('{kind = "modes", count = 5%s}' % load, lossy)
            damped = self.channels('{kind = "modes", count = 5, damping = true%s}' % load, lossy)
            self.assertNotIn("damping", relaxed)
            for f, slow, share in zip(damped["frequency"], relaxed["frequency"], damped["damping"]):
                self.assertGreater(f, slow)
                self.assertTrue(0.002 < share < 0.075, share)

    def test_relaxed_moduli_are_told(self):
        said = self.latsch("test", self.folder / self.lossy(), '{kind = "modes", count = 2}')
        self.assertIn("relaxed moduli", said)
        self.assertIn("damping = true", said)
        self.assertNotIn("relaxed moduli", self.latsch("test", self.folder / "tire.toml", '{kind = "modes", count = 2}'))

    def test_waves_of_a_spinning_tire_are_damped(self):
        test = '{kind = "modes", count = 6, speed = "40 rad/s", rim = "held"%s}'
        relaxed, damped = (self.channels(test % more, self.lossy()) for more in ("", ", damping = true"))
        self.assertNotIn("damping", relaxed)
        for f, slow, share in zip(damped["frequency_on_tire"], relaxed["frequency_on_tire"], damped["damping"]):
            self.assertTrue(0.001 < share < 0.3, share)
        self.assertGreater(sum(damped["frequency_on_tire"]), sum(relaxed["frequency_on_tire"]))
        self.assertIn(-1.0, damped["sense"])

    def test_what_cannot_be_damped_is_refused(self):
        said = self.latsch("test", self.folder / "tire.toml", '{kind = "modes", count = 2, damping = true}', code=FAILED)
        self.assertIn("loss_factor", said)


class Spinning(RotatingTire):
    def test_waves_split_by_twice_n_times_the_speed_at_most(self):
        rest = self.channels('{kind = "modes", count = 8}')
        spin = self.channels('{kind = "modes", count = 8, speed = "60 rad/s"}')
        self.assertEqual(spin["spin"], [60.0])
        self.assertNotIn("sense", rest)
        lateral = {sense: f for f, n, kind, sense in zip(spin["frequency"], spin["n"], spin["type"], spin["sense"])
                   if (n, kind) == (1, 1)}
        pair = [f for f, n, kind in zip(rest["frequency"], rest["n"], rest["type"]) if (n, kind) == (1, 1)]
        self.assertLess(lateral[-1.0], pair[0])
        self.assertLess(lateral[-1.0] + 0.5, pair[0])
        for f, on_tire, n, sense in zip(spin["frequency"], spin["frequency_on_tire"], spin["n"], spin["sense"]):
            self.assertAlmostEqual(f - on_tire, sense * n * 60.0 / (2 * math.pi), delta=1e-9)

    def test_a_road_speed_is_one_of_rotation_on_the_radius_of_the_tire_at_rest(self):
        radius = self.channels('{kind = "inflation"}')["outer_radius"][0]
        grown = self.channels('{kind = "inflation", speed = "108 km/h"}')
        self.assertAlmostEqual(grown["spin"][0] * radius, 30.0, delta=1e-9)
        same = self.channels('{kind = "inflation", speed = "%.15g rad/s"}' % grown["spin"][0])
        self.assertAlmostEqual(same["growth"][0], grown["growth"][0], delta=1e-12)
        self.assertGreater(grown["outer_radius"][0], radius)

    def test_growth_is_that_of_the_square_of_the_speed(self):
        growth = [self.channels('{kind = "inflation"%s}' % speed)["growth"][0]
                  for speed in ('', ', speed = "20 rad/s"', ', speed = "40 rad/s"')]
        self.assertAlmostEqual((growth[2] - growth[0]) / (growth[1] - growth[0]), 4.0, delta=0.05)

    def test_speeds_above_the_standing_wave_are_refused_in_words(self):
        found = self.channels('{kind = "modes", count = 2, standing_wave = true}')
        speed, n = found["standing_wave_speed"][0], int(found["standing_wave_n"][0])
        self.channels('{kind = "modes", count = 2, speed = "%g rad/s"}' % (0.99 * speed))
        said = self.latsch("test", self.folder / "tire.toml",
                           '{kind = "modes", count = 2, speed = "%g rad/s"}' % (1.01 * speed), code=FAILED)
        for part in ("standing-wave speed of %.4g" % speed, "km/h", f"n = {n}"):
            self.assertIn(part, said)

    def test_a_rim_that_moves_lowers_no_mode_of_n_2(self):
        tire = self.with_rim()
        held = self.channels('{kind = "modes", count = 12, speed = "50 rad/s"}', tire)
        free = self.channels('{kind = "modes", count = 12, speed = "50 rad/s", rim = "free"}', tire)
        def of(found, n):
            return [f for f, m in zip(found["frequency"], found["n"]) if m == n]
        self.assertAlmostEqual(of(held, 2)[0], of(free, 2)[0], delta=1e-4)
        self.assertGreater(of(free, 0)[0], of(held, 0)[0])

    def test_combinations_without_meaning_are_refused(self):
        for keys, *parts in (
                ('speed = "100 km/h", load = "2 kN"', "speed", "load", "in the air"),
                ('speed = "100 km/h", deflection = "9 mm"', "speed", "deflection"),
                ('speed = "100 km/h", friction = 0.8', "friction", "in the air"),
                ('speed = "100 km/h", camber = "2 deg"', "camber", "in the air"),
                ('rim = "free", load = "2 kN"', "rim", "load"),
                ('standing_wave = true, load = "2 kN"', "standing_wave", "load"),
                ('speed = "5 kg"', "speed", "km/h", "rad/s"),
                ('speed = 30', "speed", "km/h", "rad/s"),
                ('speed = "0 km/h"', "speed", "0"),
                ('speed = "5000 km/h"', "speed", "5000", "1440 km/h"),
                ('rim = "fre"', "rim", "free"),
                ('rim = "free"', "[rim]", "mass")):
            with self.subTest(keys):
                self.refused('{kind = "modes", %s}' % keys, *parts)

    def test_a_rim_that_no_body_can_be_is_refused(self):
        for old, new, *parts in (('"9 kg"', '"0 kg"', "rim.mass"), ('"9 kg"', '"-1 kg"', "rim.mass"),
                                 ('"0.25 kg m^2"', '"0.4 kg m^2"', "rim.inertia_spin", "twice"),
                                 ('inertia_diameter = "0.18 kg m^2"', '', "inertia_diameter")):
            with self.subTest(new):
                self.refused('{kind = "modes"}', *parts, tire=self.with_rim(RIM.replace(old, new)))

    def test_rings_do_not_spin(self):
        ring = pathlib.Path(__file__).resolve().parents[3] / "studies/ring_tires/passenger_205_55R16.toml"
        for test in ('{kind = "modes", speed = "90 rad/s"}', '{kind = "inflation", speed = "90 rad/s"}'):
            said = self.latsch("test", ring, test, code=WRONG_INPUT)
            self.assertIn("finite-element tire", said)


class Rolling(RotatingTire):
    """The test "rolling": closed limits of a wheel with friction, and requests without meaning."""

    ROLLING = '{kind = "rolling", load = "2 kN", speed = "36 km/h", %s}'

    def test_a_wheel_without_friction_has_neither_force_nor_moment(self):
        state = self.channels(self.ROLLING % "friction = 0")
        self.assertAlmostEqual(state["Fz"][0], 2000.0, delta=1e-3)
        for name in ("Fx", "Fy", "drive"):
            self.assertAlmostEqual(state[name][0], 0.0, delta=1e-3, msg=name)

    def test_a_free_wheel_needs_no_drive_and_a_locked_one_slides(self):
        free = self.channels(self.ROLLING % "friction = 0.8")
        self.assertAlmostEqual(free["drive"][0], 0.0, delta=1e-3)
        self.assertAlmostEqual(free["R_e"][0] * free["omega"][0], 10.0, delta=1e-9)
        self.assertGreater(free["sticking"][0], 0.5)
        locked = self.channels(self.ROLLING % "friction = 0.8, kappa = -1")
        self.assertEqual(locked["omega"], [0.0])
        self.assertAlmostEqual(math.hypot(locked["Fx"][0], locked["Fy"][0]), 1600.0, delta=1.6)
        self.assertLess(locked["Fx"][0], -1500.0)
        self.assertAlmostEqual(locked["loss_friction"][0], 16000.0, delta=160.0)

    def test_slip_angles_push_against_the_slip_up_to_the_limit_of_friction(self):
        states = self.channels(self.ROLLING % 'friction = 0.8, alpha = ["-1 deg", "0 deg", "1 deg", "2 deg"]')
        self.assertEqual(len(states["Fy"]), 4)
        for one, next_one in zip(states["Fy"], states["Fy"][1:]):
            self.assertGreater(one, next_one)
        for i in range(4):
            self.assertLessEqual(math.hypot(states["Fx"][i], states["Fy"][i]), 1600.0 * (1 + 1e-6))

    def test_a_drum_shortens_the_patch(self):
        flat = self.channels(self.ROLLING % "friction = 0.8")
        drum = self.channels(self.ROLLING % 'friction = 0.8, drum_radius = "0.85 m"')
        self.assertLess(drum["length"][0], flat["length"][0])
        self.assertLess(drum["R_l"][0], flat["R_l"][0])  # because the load presses the tire deeper
        self.assertAlmostEqual(drum["Fz"][0], flat["Fz"][0], delta=0.01)

    def test_the_page_draws_what_varies(self):
        page = self.folder / "page.html"
        self.latsch("test", self.folder / "tire.toml", self.ROLLING % 'friction = 0.8, alpha = ["-1 deg", "1 deg"]',
                    "--html", page)
        text = page.read_text()
        self.assertIn("not drawn, because constant: gamma, phit, Vx, p, Fz", text)
        self.assertRegex(text, r"Fy \[k?N\] over alpha \[deg\]")  # the unit goes by the largest force
        self.assertNotIn("Vx [m/s] over", text)

    def test_requests_without_meaning_are_refused(self):
        for keys, *parts in (('friction = 0, alpha = "1 deg"', "friction"), ('friction = -1', "friction", "0 to 5"),
                             ('friction = 0.8, drum_radius = "0 m"', "drum_radius"),
                             ('friction = 0.8, drum_radius = "1 m", turn_slip = "0.1 1/m"', "drum_radius", "turn"),
                             ('friction = 0.8, kappa = -2', "kappa"), ('friction = 0.8, alpha = "90 deg"', "alpha"),
                             ('friction = 0.8, alpha = ["1 deg", "2 deg"], camber = ["1 deg", "2 deg", "3 deg"]', "2", "3")):
            with self.subTest(keys):
                self.refused(self.ROLLING % keys, *parts)


class Losses(RotatingTire):
    """Losses of a tire that rolls: by part, in words, and refused where no rubber has them."""

    ROLLING = '{kind = "rolling", load = "2 kN", speed = "36 km/h", friction = 0.8}'

    def rolled(self, tire):
        return {name: values[0] for name, values in self.channels(self.ROLLING, tire).items()}

    def test_an_elastic_tire_has_the_resistance_of_friction_alone_and_says_so(self):
        found = self.rolled("tire.toml")
        self.assertEqual(found["loss_rubber"], 0.0)
        self.assertAlmostEqual(found["rolling_resistance"], found["loss_friction"] / 10.0, delta=1e-12)
        self.assertIn("friction alone", self.latsch("test", self.folder / "tire.toml", self.ROLLING))

    def test_resistance_is_the_sum_of_the_parts_over_the_speed(self):
        rubbers = {table.replace(".", "__"): "loss_factor = 0.15" for table in self.tables("rubber")}
        layers = {table.replace(".", "__"): "loss_factor = 0.02" for table in self.tables("layer")}
        tire = self.with_keys(**rubbers, **layers)
        for name in (tire, "tire.toml"):  # a history needs some sectors within the patch
            file = self.folder / name
            file.write_text(file.read_text().replace("sectors = 18", "sectors = 36"))
        found, elastic = self.rolled(tire), self.rolled("tire.toml")
        self.assertAlmostEqual(found["Fz"], elastic["Fz"], delta=0.01)
        self.assertLess(found["Fx"], elastic["Fx"] - 0.5 * found["rolling_resistance"])  # losses brake the wheel
        self.assertLess(found["My"], elastic["My"])  # the load moves forward
        self.assertGreater(found["loss_rubber"], found["loss_cords"])
        self.assertGreater(found["loss_cords"], 0.0)
        parts = {name: value for name, value in found.items() if name.startswith("loss.")}
        self.assertEqual(len(parts), len(rubbers) + len(layers))
        self.assertAlmostEqual(sum(parts.values()), found["loss_rubber"] + found["loss_cords"], delta=1e-9)
        self.assertAlmostEqual(10.0 * found["rolling_resistance"],
                               sum(parts.values()) + found["loss_friction"], delta=1e-9)
        self.assertGreater(found["rolling_resistance"] / found["Fz"], 0.002)
        self.assertLess(found["rolling_resistance"] / found["Fz"], 0.04)
        self.assertIn("storage moduli", self.latsch("test", self.folder / tire, self.ROLLING))

    def test_losses_that_no_rubber_has_are_refused(self):
        rubber = self.tables("rubber")[0].replace(".", "__")
        layer = self.tables("layer")[0].replace(".", "__")
        for table, line, *parts in ((rubber, 'prony = [[-0.2, "1 ms"]]', "prony", "below 0"),
                                    (rubber, 'prony = [[0.2, "0 s"]]', "prony", "relaxation time"),
                                    (rubber, 'prony = [[40, "1 s"], [20, "2 s"]]', "prony", "50"),
                                    (rubber, 'prony = [[0.2, "1 s"], [0.1, "1000 ms"]]', "same relaxation time"),
                                    (rubber, 'loss_factor = 1.5', "loss_factor", "0 to 1"),
                                    (layer, 'loss_factor = -0.5', "loss_factor", "0 to 1"),
                                    (layer, 'prony = [[0.2, "1 kg"]]', "prony", "kg")):
            with self.subTest(line):
                tire = self.with_keys(**{table: line})
                said = self.latsch("test", self.folder / tire, self.ROLLING, code=WRONG_INPUT)
                for part in (*parts, "lossy.toml:"):
                    self.assertIn(part, said)


class RollingFootprint(RotatingTire):
    """The patch of a tire that rolls: its sums are the forces of the test "rolling"."""

    STATES = 'load = "2 kN", speed = "36 km/h", friction = 0.8, alpha = ["0 deg", "8 deg"]'

    def points(self):
        table = self.folder / "points.csv"
        self.latsch("test", self.folder / "tire.toml", '{kind = "rolling_footprint", %s}' % self.STATES,
                    "--details", table)
        head, *rows = table.read_text().splitlines()
        names = [name.split(" ")[0].strip('"') for name in head.split(",")]
        return [dict(zip(names, map(float, row.split(",")))) for row in rows]

    def test_its_means_are_those_of_the_forces(self):
        rolled = self.channels('{kind = "rolling", %s}' % self.STATES)
        prints = self.channels('{kind = "rolling_footprint", %s}' % self.STATES)
        for k in range(2):
            self.assertEqual(prints["load"][k], rolled["Fz"][k])
            self.assertEqual(prints["loss_friction"][k], rolled["loss_friction"][k])
            self.assertAlmostEqual(prints["sticking"][k], rolled["sticking"][k], delta=1e-9)
            self.assertAlmostEqual(prints["area"][k] * prints["mean_pressure"][k], rolled["Fz"][k], delta=1e-6)
        # Sideslip uses more of the friction, and all sliding points use all of theirs.
        self.assertGreater(prints["grip_level"][1], 2.0 * prints["grip_level"][0])
        self.assertGreater(prints["sliding_speed"][1], prints["sliding_speed"][0])

    def test_points_obey_the_law_of_friction(self):
        points = self.points()
        self.assertEqual({at["state"] for at in points}, {1.0, 2.0})
        for at in points:
            shear = math.hypot(at["shear_x"], at["shear_y"])
            self.assertAlmostEqual(at["grip"], min(1.0, shear / (0.8 * at["pressure"])), delta=1e-6)
            slide = math.hypot(at["slide_x"], at["slide_y"])
            if slide > 1e-9:
                self.assertAlmostEqual(at["grip"], 1.0, delta=1e-6)
                # Friction acts against the sliding.
                self.assertAlmostEqual(at["shear_x"] * at["slide_x"] + at["shear_y"] * at["slide_y"],
                                       -shear * slide, delta=1e-6 * shear * slide + 1e-9)

    def test_one_sensor_below_the_whole_patch_reads_the_forces(self):
        rolled = self.channels('{kind = "rolling", %s}' % self.STATES)
        side = 0.1
        read = self.channels('{kind = "rolling_footprint", %s, sensor = "100 mm", sensors = [%s]}' % (
            self.STATES, ", ".join('["%g mm", "%g mm"]' % (x, y) for x in (-100, 0, 100) for y in (-100, 0, 100))))
        for k in range(2):
            for name, force in (("pressure", "Fz"), ("shear_y", "Fy")):
                total = sum(read[name][9 * k:9 * k + 9]) * side * side
                self.assertAlmostEqual(total, rolled[force][k], delta=1e-6 * rolled["Fz"][k])

    def test_requests_without_meaning_are_refused(self):
        for keys, *parts in (('sensor = "1 m"', "sensor", "0.1"), ('sensors = [["1 mm"]]', "sensors"),
                             ('sensors = [["1 N", "2 mm"]]', "sensors"), ('senors = [["1 mm", "2 mm"]]', "senors")):
            with self.subTest(keys):
                self.refused('{kind = "rolling_footprint", %s, %s}' % (self.STATES, keys), *parts)
        self.refused('{kind = "rolling_footprint", load = "2 kN", speed = "36 km/h", friction = 0, alpha = "1 deg"}',
                     "friction")


class RollingChain(RotatingTire):
    """Points around a tire that rolls: motion, strain and losses at a place of the section."""

    STATES = 'load = "2 kN", speed = "36 km/h", friction = 0.8'

    def test_points_lie_on_the_ground_below_the_wheel_and_hardly_slide(self):
        rolled = self.channels('{kind = "rolling", %s}' % self.STATES)
        chain = self.channels('{kind = "rolling_chain", %s, depth = "outer"}' % self.STATES)
        lowest = min(range(len(chain["z"])), key=lambda k: chain["z"][k])
        # Points are in the middles of sectors of 20 deg, the patch is shorter: the lowest point is above the ground,
        # by less than a tire that is not pressed flat would be.
        ground = rolled["R_l"][0]
        self.assertLess(-chain["z"][lowest], ground + 1e-4)
        self.assertGreater(-chain["z"][lowest], ground * math.cos(chain["theta"][lowest]))
        self.assertLess(abs(chain["theta"][lowest]), 0.4)
        # The hub travels at 10 m/s; tread on the ground moves backward at the same speed.
        self.assertAlmostEqual(chain["v_x"][lowest], -10.0, delta=0.8)
        top = max(range(len(chain["z"])), key=lambda k: chain["z"][k])
        self.assertGreater(chain["v_x"][top], 9.0)
        self.assertEqual(chain["theta"], sorted(chain["theta"]))

    def test_pictures_of_nothing_but_zeros_are_left_out(self):
        page = self.folder / "page.html"
        self.latsch("test", self.folder / "tire.toml", '{kind = "rolling_chain", %s}' % self.STATES, "--html", page)
        text = page.read_text()
        self.assertIn("Stored energy", text)
        self.assertIn("1 chain of points", text)
        self.assertNotIn("Force of the cords", text)  # the outer face has none
        self.assertNotIn("Dissipation", text)  # the tire is elastic

    def test_a_layer_has_cord_forces_and_lossy_rubber_dissipates(self):
        layer = [line[len("[layer."):-1] for line in (self.folder / "tire.toml").read_text().splitlines()
                 if line.startswith("[layer.")][0]
        text = (self.folder / "tire.toml").read_text()
        (self.folder / "lossy.toml").write_text(re.sub(r"(\[rubber\..*\]\n)", r"\1loss_factor = 0.15\n", text))
        keys = '{kind = "rolling_chain", %s, depth = "%s", position = [0, 0.4]}'
        chain = self.channels(keys % (self.STATES, layer), "lossy.toml")
        self.assertEqual(set(chain["position"]), {0.0, 0.4})
        self.assertGreater(max(map(abs, chain["cord_force"])), 1.0)
        self.assertGreater(max(chain["dissipation"]), 0.0)
        self.assertGreaterEqual(min(chain["dissipation"]), -1e-3 * max(chain["dissipation"]))
        elastic = self.channels(keys % (self.STATES, "outer"))
        self.assertEqual(set(elastic["cord_force"]) | set(elastic["dissipation"]), {0.0})

    def test_places_off_the_wall_are_refused(self):
        for keys, *parts in (('position = 1.2', "position", "-1 to 1"), ('position = []', "position"),
                             ('position = "1 mm"', "position")):
            with self.subTest(keys):
                self.refused('{kind = "rolling_chain", %s, %s}' % (self.STATES, keys), *parts)
        said = self.latsch("test", self.folder / "tire.toml",
                           '{kind = "rolling_chain", %s, depth = "belt_9"}' % self.STATES, code=FAILED)
        for part in ("belt_9", "inner, outer or", "position 0"):
            self.assertIn(part, said)


if __name__ == "__main__":
    unittest.main()
