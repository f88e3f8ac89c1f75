#!/usr/bin/env python3
"""Tests the response of a rolling finite-element tire to slips that change: relaxation.

   rolling_response_test.py PATH/TO/latsch"""
import cmath
import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import FAILED, WRONG_INPUT, Coarse

STATE = 'load = "3 kN", speed = "60 km/h", friction = 1.0'


class RollingResponse(Coarse):
    def channels(self, test, tire="tire.toml"):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / tire, test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def test_slowly_is_the_slope_of_steady_forces(self):
        found = self.channels('{kind = "rolling_response", %s, inputs = ["alpha", "kappa", "gamma", "phit"], '
                              'frequencies = ["1 mHz", "1 Hz"]}' % STATE)
        self.assertEqual(found["frequency"], [1e-3, 1.0])
        self.assertAlmostEqual(found["path_frequency"][1], 2 * math.pi / (60 / 3.6), delta=1e-12)
        for slip, key, step, unit, forces in (("alpha", "alpha", 2e-4, "rad", ("Fy", "Mz")), ("kappa", "kappa", 2e-5, "", ("Fx",)),
                                              ("gamma", "camber", 1e-3, "rad", ("Fy", "Mx", "Mz")), ("phit", "turn_slip", 1e-3, "1/m", ("Mz",))):
            values = ", ".join(f'"{value:g} {unit}"' if unit else f"{value:g}" for value in (step, -step))
            kappa = "" if slip == "kappa" else ", kappa = 0"
            steady = self.channels('{kind = "rolling", %s, %s = [%s]%s}' % (STATE, key, values, kappa))
            for force in forces:
                slope = (steady[force][0] - steady[force][1]) / (2 * step)
                with self.subTest(f"{force} by {slip}"):
                    # Steady states are known to 1e-6 of the load; rolling_response_test.cpp has closer ones.
                    self.assertAlmostEqual(found[f"re_{force}_by_{slip}"][0] / slope, 1.0, delta=5e-3)

    def test_a_force_lags_by_the_relaxation_length(self):
        found = self.channels('{kind = "rolling_response", %s, from = "0.5 Hz", to = "1.5 Hz", step = "0.5 Hz"}' % STATE)
        for name, length in (("Fy_by_alpha", "relaxation_side"), ("Fx_by_kappa", "relaxation_slip")):
            for k, sigma in enumerate(found[length]):
                value = complex(found["re_" + name][k], found["im_" + name][k])
                self.assertAlmostEqual(abs(value), found["tf_" + name][k], delta=1e-9 * abs(value))
                self.assertAlmostEqual(cmath.phase(value), found["phase_" + name][k], delta=1e-9)
                self.assertAlmostEqual(sigma, -value.imag / value.real / found["path_frequency"][k], delta=1e-9)
                self.assertTrue(0.03 < sigma < 1.0, sigma)

    def test_states_follow_each_other_and_a_held_axle_changes_the_load(self):
        test = '{kind = "rolling_response", load = ["2 kN", "4 kN"], speed = "60 km/h", alpha = "3 deg", friction = 0.8, ' \
               'frequencies = ["0.5 Hz", "2 Hz"], axle = "%s"}'
        load, height = (self.channels(test % axle) for axle in ("load", "height"))
        self.assertEqual(load["state"], [1.0, 1.0, 2.0, 2.0])
        self.assertEqual(load["frequency"], [0.5, 2.0, 0.5, 2.0])
        self.assertGreater(load["relaxation_side"][2], load["relaxation_side"][0])
        for follows, held in zip(load["tf_Fz_by_alpha"], height["tf_Fz_by_alpha"]):
            self.assertLess(follows, 1e-6)
            self.assertGreater(held, 10.0)

    def test_what_is_left_out_is_told(self):
        test = '{kind = "rolling_response", %s, frequencies = ["1 Hz"]}' % STATE
        said = self.latsch("test", self.folder / "tire.toml", test)
        self.assertIn("inertia of the change is left out", said)
        self.assertNotIn("storage moduli", said)
        text = (self.folder / "tire.toml").read_text()
        (self.folder / "lossy.toml").write_text(text.replace("[rubber.tread]\n", "[rubber.tread]\nloss_factor = 0.15\n", 1))
        self.assertIn("storage moduli", self.latsch("test", self.folder / "lossy.toml", test))

    def test_a_page_draws_forces_and_lengths(self):
        page = self.folder / "relax.html"
        self.latsch("test", self.folder / "tire.toml",
                    '{kind = "rolling_response", %s, frequencies = ["0.5 Hz", "2 Hz"]}' % STATE, "--html", page)
        text = page.read_text()
        for part in ("Relaxation lengths", "Fy by slip angle: size", "Fx and Mz by slip: phase"):
            self.assertIn(part, text)

    def test_what_cannot_be_is_refused(self):
        for keys, code, *parts in (
                ('load = "3 kN", speed = "60 km/h", friction = 0, frequencies = ["1 Hz"]', WRONG_INPUT, "friction is 0", "no force follows a slip"),
                (STATE + ', frequencies = ["1 Hz"], drum_radius = "0.8 m"', WRONG_INPUT, "drum_radius", "flat ground"),
                (STATE + ', frequencies = ["1 Hz"], inputs = ["beta"]', WRONG_INPUT, 'inputs names "beta"', '"phit"'),
                (STATE + ', frequencies = ["1 Hz"], inputs = []', WRONG_INPUT, "inputs is empty", '"alpha"'),
                (STATE + ', frequencies = ["1 Hz"], inputs = ["alpha", "alpha"]', WRONG_INPUT, "twice"),
                (STATE + ', frequencies = ["300 Hz"]', WRONG_INPUT, "300 Hz", "200 Hz at most"),
                (STATE + ', frequencies = ["100 Hz"]', WRONG_INPUT, "100 Hz", "60 km/h", "sector", "Hz at most"),
                (STATE + ', from = "3 Hz", to = "1 Hz"', WRONG_INPUT, "to", "below from"),
                ('load = "3 kN", speed = "0 km/h", frequencies = ["1 Hz"]', WRONG_INPUT, "speed is 0"),
                (STATE + ', kappa = -1, frequencies = ["1 Hz"]', FAILED, "state 1 of 1", "locked", "expected -0.95 or more"),
                ('load = "60 kN", speed = "60 km/h", frequencies = ["1 Hz"]', FAILED, "deflection", "the rim holds the tire up to")):
            with self.subTest(keys):
                said = self.latsch("test", self.folder / "tire.toml", '{kind = "rolling_response", %s}' % keys, code=code)
                for part in parts:
                    self.assertIn(part, said)


if __name__ == "__main__":
    unittest.main()
