#!/usr/bin/env python3
"""Tests the steady states and the rolling stiffnesses of a finite-element tire, and its friction as a variable of a study.

   steady_tire_test.py PATH/TO/latsch"""
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import WRONG_INPUT, Coarse

TREE = pathlib.Path(__file__).resolve().parents[4]
STEADY = '{kind = "steady_states", states = "%s"%s}'
HISTORY = '{kind = "slip_history", states = "%s"%s}'


class SteadyTire(Coarse):
    def states(self, text, name="states.csv"):
        (self.folder / name).write_text(text)
        return self.folder / name

    def channels(self, test, tire="tire.toml"):
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("test", self.folder / tire, test, "--json"))
        return {channel["name"]: channel["values"] for channel in answer["result"]["channels"]}

    def slippery(self, friction):
        text = (self.folder / "tire.toml").read_text()
        (self.folder / "slippery.toml").write_text(f"friction = {friction}\n" + text)
        return "slippery.toml"

    def test_the_tire_has_the_channels_of_its_states_and_says_what_it_assumes(self):
        table = self.states("Fz [kN],alpha [deg]\n2,1\n2,-1\n")
        found = self.channels(STEADY % (table, ""))
        self.assertLess(found["Fy"][0], 0.0)
        self.assertGreater(found["Fy"][1], 0.0)
        self.assertEqual([round(Fz, 3) for Fz in found["Fz"]], [2000.0, 2000.0])
        self.assertEqual(set(found), {"Fx", "Fy", "Fz", "Mx", "My", "Mz", "R_e", "R_l", "length", "width", "omega"})
        said = self.latsch("test", self.folder / "tire.toml", STEADY % (table, ""))
        for part in ("friction 1 is taken", "kappa = 0", "Vx = 16.67 m/s", "no rolling resistance"):
            self.assertIn(part, said)
        self.assertNotIn("friction 1 is taken", self.latsch("test", self.folder / "tire.toml", STEADY % (table, ", friction = 0.9")))

    def test_a_locked_wheel_slides_with_the_friction_of_test_or_file(self):
        table = self.states("Fz [kN],kappa\n2,-1\n")
        tire = self.slippery(0.6)
        self.assertAlmostEqual(self.channels(STEADY % (table, ""), tire)["Fx"][0], -1200.0, delta=0.1)
        self.assertAlmostEqual(self.channels(STEADY % (table, ", friction = 0.8"), tire)["Fx"][0], -1600.0, delta=0.1)

    def test_a_study_finds_the_friction_of_the_file(self):
        self.states("Fz [kN],kappa\n2,-1\n3,-1\n")
        self.slippery(0.6)
        (self.folder / "locked.csv").write_text("Fx [N]\n-1700\n-2550\n")
        (self.folder / "study.toml").write_text("""
model = "slippery.toml"
[test.locked]
kind = "steady_states"
states = "states.csv"
[variable.friction]
path = "friction"
lower = 0.3
upper = 1.5
initial = 0.6
[experiment.braking]
kind = "curve"
y = "locked/Fx"
measurement = "locked.csv"
exponent = 2
""")
        answer, _ = json.JSONDecoder().raw_decode(self.latsch("run", self.folder / "study.toml", "--json"))
        friction = answer["result"]["variables"][0]
        self.assertEqual(friction["name"], "friction")
        self.assertAlmostEqual(friction["value"], 0.85, delta=1e-3)

    def test_stiffnesses_come_from_the_states(self):
        keys = '{kind = "rolling_stiffness", load = "2 kN", measures = ["cornering"], angle = "0.25 deg"}'
        found = self.channels(keys)
        pair = self.channels(STEADY % (self.states("Fz [kN],alpha [deg]\n2,0.25\n2,-0.25\n"), ""))
        angle = 0.25 * 3.14159265358979 / 180.0
        self.assertAlmostEqual(found["cornering_stiffness"][0] / (-(pair["Fy"][0] - pair["Fy"][1]) / (2 * angle)), 1.0, delta=1e-6)
        self.assertIn("friction 1 is taken", self.latsch("test", self.folder / "tire.toml", keys))

    def test_a_record_is_rolled_in_time_and_lags(self):
        rows = "".join(f"{0.01 * k:.2f},2,{min(k, 2)}\n" for k in range(12))
        table = self.states("time [s],Fz [kN],alpha [deg]\n" + rows)
        test = HISTORY % (table, ', step = "5 ms"')
        found = self.channels(test)
        self.assertEqual(set(found), {"Fx", "Fy", "Fz", "Mx", "My", "Mz", "R_e", "R_l", "length", "width", "omega"})
        self.assertEqual(len(found["Fy"]), 12)
        steady = self.channels(STEADY % (self.states("Fz [kN],alpha [deg]\n2,0\n2,2\n", "ends.csv"), ""))
        for force in ("Fx", "Fy", "Fz", "Mz"):
            self.assertAlmostEqual(found[force][0], steady[force][0], delta=1.0)
        reached = [(Fy - steady["Fy"][0]) / (steady["Fy"][1] - steady["Fy"][0]) for Fy in found["Fy"]]
        self.assertTrue(0.0 < reached[1] < 0.5 and 0.1 < reached[2] < 0.9, reached)  # 0.17 m of road a sample
        self.assertAlmostEqual(reached[-1], 1.0, delta=0.05)
        said = self.latsch("test", self.folder / "tire.toml", test)
        for part in ("22 steps of 5 ms", "without turn slip", "kappa = 0", "friction 1 is taken"):
            self.assertIn(part, said)

    def test_what_such_a_tire_does_not_do_is_refused_in_words(self):
        table = self.states("time [s],Fz [kN],alpha [deg]\n0,2,1\n0.1,2,2\n")
        for keys, *parts in ((STEADY % (table, ', angles = "tangent"'), "tangent", "direct"),
                             (STEADY % (table, ", friction = 7"), "friction", "0 to 5"),
                             (HISTORY % (table, ', step = "0 s"'), "step"),
                             (HISTORY % (table, ", friction = 0"), "friction", "above 0"),
                             (HISTORY % (table, ', stpe = "1 ms"'), "stpe", "step")):
            with self.subTest(keys):
                said = self.latsch("test", self.folder / "tire.toml", keys, code=WRONG_INPUT)
                for part in parts:
                    self.assertIn(part, said)
        air = self.states("Fz [kN]\n2\n0\n", "air.csv")
        self.assertIn("air.csv:3: Fz (N) is 0, expected a load above 0",
                      self.latsch("test", self.folder / "tire.toml", STEADY % (air, ""), code=WRONG_INPUT))

    def test_a_study_with_such_a_test_is_refused_before_it_runs(self):
        self.states("Fz [kN],alpha [deg]\n2,1\n")
        (self.folder / "side.csv").write_text("Fy [N]\n-300\n")
        study = """
model = "tire.toml"
[test.steady]
kind = "steady_states"
states = "states.csv"
%s
[variable.belt]
path = "rubber.%s.young_modulus"
lower = "1 MPa"
upper = "100 MPa"
initial = "5 MPa"
[experiment.side]
kind = "curve"
y = "steady/%s"
measurement = "side.csv"
"""
        rubber = next(line for line in (self.folder / "tire.toml").read_text().splitlines() if line.startswith("[rubber."))[8:-1]
        (self.folder / "study.toml").write_text(study % ('angles = "tangent"', rubber, "Fy"))
        self.assertIn("makes every trial fail", self.latsch("check", self.folder / "study.toml", code=WRONG_INPUT))
        (self.folder / "study.toml").write_text(study % ("", rubber, "Fy"))
        self.assertIn("friction 1 is taken", self.latsch("check", self.folder / "study.toml"))

    def test_a_magic_formula_refuses_friction(self):
        table = self.states("Fz [kN],alpha [deg]\n2,1\n")
        tir = TREE / "studies/race_tire_mf/tire.tir"
        said = self.latsch("test", tir, STEADY % (table, ", friction = 0.9"), code=WRONG_INPUT)
        self.assertIn("friction", said)
        self.assertIn("fe_tire", said)


if __name__ == "__main__":
    unittest.main()
