#!/usr/bin/env python3
"""Tests the frequency response of a finite-element tire, and a measured response in a study.

   fe_response_test.py PATH/TO/latsch"""
import cmath
import json
import math
import re
import unittest

from cli_testing import FAILED, WRONG_INPUT, Coarse

RIM = """
[rim]
mass = "9 kg"
inertia_spin = "0.25 kg m^2"
inertia_diameter = "0.18 kg m^2"
"""

GROUND = '{kind = "response", deflection = "8 mm", input = "ground", frequencies = ["0.1 Hz", "20 Hz", "60 Hz"]%s}'


class RespondingTire(Coarse):
    def channels(self, test, tire="tire.toml"):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / tire, test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def refused(self, test, *parts, tire="tire.toml"):
        said = self.latsch("test", self.folder / tire, test, code=WRONG_INPUT)
        for part in parts:
            self.assertIn(part, said)

    def lossy(self):
        text = (self.folder / "tire.toml").read_text()
        lines = [line + ("\nloss_factor = 0.15" if line.startswith("[rubber.") else "") for line in text.splitlines()]
        (self.folder / "lossy.toml").write_text("\n".join(lines) + "\n" + RIM)
        return "lossy.toml"


class Response(RespondingTire):
    def test_slowly_is_the_slope_of_the_load(self):
        found = self.channels(GROUND % "")
        pressed = self.channels('{kind = "load_deflection", deflections = ["7.99 mm", "8.01 mm"]}')
        slope = (pressed["force"][1] - pressed["force"][0]) / 2e-5
        self.assertAlmostEqual(found["re_patch_Fz"][0] / slope, 1.0, delta=5e-3)
        self.assertAlmostEqual(found["re_hub_Fz"][0] / slope, 1.0, delta=5e-3)
        self.assertAlmostEqual(found["deflection"][0], 0.008, delta=1e-12)

    def test_parts_size_and_phase_are_of_one_number(self):
        found = self.channels(GROUND % "", self.lossy())
        for k in range(3):
            value = complex(found["re_hub_Fz"][k], found["im_hub_Fz"][k])
            self.assertAlmostEqual(abs(value), found["tf_hub_Fz"][k], delta=1e-9 * abs(value))
            self.assertAlmostEqual(cmath.phase(value), found["phase_hub_Fz"][k], delta=1e-9)
        self.assertGreater(found["im_patch_Fz"][1], 0.0)  # rubber that relaxes keeps the force behind the motion

    def test_a_free_rim_on_a_tire_in_the_air_is_the_whole_wheel(self):
        # Far below the lowest mode the wheel, tire and rim, moves as one mass.
        test = ('{kind = "response", rim = "free", input = "hub", direction = "x", frequencies = ["1 Hz"], '
                'motion = "acceleration"}')
        mass = self.channels('{kind = "mass_properties"}')["mass"][0] + 9.0
        found = self.channels(test, self.lossy())
        self.assertAlmostEqual(found["re_rim_x"][0] * mass, 1.0, delta=5e-3)

    def test_a_point_moves_where_it_is_hit(self):
        test = ('{kind = "response", input = "point", at = ["0 mm", "0 mm", "%g mm"], direction = "radial", '
                'frequencies = ["30 Hz"], points = [["0 mm", "0 mm", "%g mm"]]}')
        radius = 1e3 * self.channels('{kind = "inflation"}')["outer_radius"][0] - 5.0
        found = self.channels(test % (radius, radius), self.lossy())
        self.assertGreater(found["re_point_1_z"][0], 0.0)
        self.assertLess(found["im_point_1_z"][0], 0.0)
        self.assertLess(math.hypot(found["re_point_1_y"][0], found["im_point_1_y"][0]), 0.5 * found["tf_point_1_z"][0])

    def test_what_cannot_be_is_refused(self):
        self.refused('{kind = "response", input = "ground", from = "1 Hz", to = "9 Hz"}', "input", "in the air")
        self.refused(GROUND % ', rim = "free"' % (), "[rim]")
        self.refused('{kind = "response", input = "hub", from = "1 Hz", to = "9 Hz"}', "input", "held")
        self.refused('{kind = "response", input = "wheel", rim = "free", from = "1 Hz", to = "9 Hz"}', "input", "hub")
        self.refused('{kind = "response", input = "wheel", frequencies = ["9 Hz", "1 Hz"]}', "frequencies", "ascending")
        self.refused('{kind = "response", input = "wheel", from = "9 Hz", to = "1 Hz"}', "to", "below from")
        self.refused('{kind = "response", input = "wheel", from = "9 Hz", to = "9 kHz", step = "1 kHz"}', "500 Hz")
        far = '{kind = "response", input = "point", at = ["0 m", "0 m", "1 m"], from = "1 Hz", to = "9 Hz"}'
        self.latsch("test", self.folder / "tire.toml", far, code=FAILED)

    def test_a_tire_that_nothing_damps_is_told(self):
        said = self.latsch("test", self.folder / "tire.toml", GROUND % "")
        self.assertIn("nothing damps the tire", said)
        self.assertNotIn("nothing damps", self.latsch("test", self.folder / self.lossy(), GROUND % ""))


STUDY = """
model = "start.toml"
[variable.sidewall]
path = "rubber.upper_sidewall.young_modulus"
lower = "2 MPa"
upper = "12 MPa"
initial = "7 MPa"
[test.shaken]
kind = "response"
deflection = "8 mm"
input = "ground"
from = "20 Hz"
to = "80 Hz"
step = "20 Hz"
[experiment.transfer]
kind = "frequency_response"
y = "shaken/hub_Fz"
measurement = "frf.csv"
noise = "1 %"
AVERAGES
[optimizer]
method = "residual_trust_region"
"""


class MeasuredResponse(RespondingTire):
    def measured(self, coherence):
        """Writes a response of the lossy tire whose third value is wrong by half, with these coherences."""
        found = self.channels('{kind = "response", deflection = "8 mm", input = "ground", from = "20 Hz", to = "80 Hz", '
                              'step = "20 Hz"}', self.lossy())
        rows = ["frequency [Hz],re_hub_Fz [N/m],im_hub_Fz [N/m],coherence"]
        for k, share in enumerate(coherence):
            factor = 1.5 if k == 2 else 1.0
            rows.append(f"{found['frequency'][k]!r},{factor * found['re_hub_Fz'][k]!r},"
                        f"{factor * found['im_hub_Fz'][k]!r},{share}")
        (self.folder / "frf.csv").write_text("\n".join(rows) + "\n")
        text = (self.folder / "lossy.toml").read_text()
        table = text.split("[rubber.upper_sidewall]")[1]
        self.truth = float(re.search('young_modulus = "([0-9.]+) MPa"', table)[1])
        start = table.replace(f'young_modulus = "{self.truth:g} MPa"', 'young_modulus = "7 MPa"', 1)
        self.assertNotEqual(start, table)
        (self.folder / "start.toml").write_text(text.split("[rubber.upper_sidewall]")[0] + "[rubber.upper_sidewall]" + start)

    def fitted(self, averages):
        (self.folder / "study.toml").write_text(STUDY.replace("AVERAGES", averages))
        said = self.latsch("run", self.folder / "study.toml")
        return float(re.search(r"\n  sidewall +(\S+)", said)[1]), float(re.search(r"target (\S+) %", said)[1])

    def test_frequencies_without_coherence_hardly_count(self):
        self.measured([0.9999, 0.9999, 1e-5, 0.9999])
        found, target = self.fitted("averages = 20")
        self.assertAlmostEqual(found / self.truth, 1.0, delta=0.01)
        self.assertLess(target, 0.1)
        (self.folder / "study.latsch").unlink()
        _, target = self.fitted("")
        self.assertGreater(target, 1.0)  # the value that is wrong by half counts as the others do

    def test_bad_coherence_is_refused(self):
        self.measured([0.9999, 0.9999, 1.5, 0.9999])
        text = STUDY.replace("AVERAGES", "averages = 20")
        for study, parts in ((text, ("coherence", "1.5", "0 to 1")),
                             (text.replace('noise = "1 %"', ""), ("averages", "noise")),
                             (text.replace("shaken/hub_Fz", "shaken/re_hub_Fz"), ("expected TEST/OUTPUT", "shaken/hub_Fz"))):
            (self.folder / "study.toml").write_text(study)
            said = self.latsch("check", self.folder / "study.toml", code=WRONG_INPUT)
            for part in parts:
                self.assertIn(part, said)


if __name__ == "__main__":
    unittest.main()
