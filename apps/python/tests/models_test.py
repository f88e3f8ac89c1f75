#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests models from Python: equality to the bit with `latsch test --json`, derivatives against differences,
parameters set by path, threads and Ctrl-C."""
import json
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

import latsch
import numpy as np
from python_testing import LATSCH, ROOT, Meanwhile

CORNER = ROOT / "studies/compliance/corner.toml"
TIR = ROOT / "studies/tire_model_comparison/magic_formula.tir"
RING = ROOT / "studies/tire_model_comparison/ring_tire.toml"
SIDE_FORCE = {"kind": "kc", "Fy": ["-4 kN", "-2 kN", "0 N", "2 kN", "4 kN"], "slopes_by": "Fy"}
OVER_A_CLEAT = {"kind": "drum_cleat", "speed": "60 km/h", "load": "4 kN", "drum_diameter": "2.5 m", "duration": "0.5 s",
                "cleat": {"height": "10 mm", "length": "30 mm"}}


def by_the_program(model, test, *options):
    """Returns (values, units) of `latsch test --json`."""
    run = subprocess.run([LATSCH, "test", model, test, "--json", *options], capture_output=True, text=True, check=True)
    channels = json.loads(run.stdout)["result"]["channels"]
    return {one["name"]: np.array(one["values"], float) for one in channels}, {one["name"]: one["unit"] for one in channels}


class Models(unittest.TestCase):
    def assert_same_bits(self, recording, program):
        values, units = program
        self.assertEqual(list(recording), list(values))
        self.assertEqual(recording.units, units)
        for name in values:
            np.testing.assert_array_equal(recording[name], values[name], err_msg=name)

    def test_what_reading_assumes_is_a_warning(self):
        with tempfile.TemporaryDirectory() as folder:
            tir = pathlib.Path(folder) / "tire.tir"
            tir.write_text("".join(line for line in TIR.read_text().splitlines(True) if not line.startswith("PCX1")))
            with self.assertWarnsRegex(UserWarning, "there is no PCX1"):
                latsch.read_model(str(tir))
            tir.write_text(re.sub("USE_MODE.*", "USE_MODE = -2", TIR.read_text()))
            with self.assertWarnsRegex(UserWarning, "USE_MODE"):
                latsch.read_model(str(tir))

    def test_channels_are_those_of_the_program(self):
        kc = '{kind = "kc", Fy = ["-4 kN", "-2 kN", "0 N", "2 kN", "4 kN"], slopes_by = "Fy"}'
        self.assert_same_bits(latsch.test(CORNER, SIDE_FORCE), by_the_program(CORNER, kc))
        rolling = '{kind = "rolling_stiffness", load = "4 kN", speed = "60 km/h"}'
        for model, kind in ((TIR, "magic_formula"), (TIR.with_name("rigid_ring.tir"), "rigid_ring")):
            self.assert_same_bits(latsch.test(model, rolling, kind=kind), by_the_program(model, rolling, "--kind", kind))

    def test_a_number_set_is_that_number_in_the_file(self):
        model = latsch.read_model(CORNER)
        path = "bushing.lbj.y"
        self.assertEqual(model.unit(path), "N/m")
        before = latsch.test(model, SIDE_FORCE)
        copy = model.copy()
        model[path] = 1.23e7
        self.assertEqual(model[path], 1.23e7)
        model[path] = "12.3 kN/mm"
        self.assertEqual(model[path], 1.23e7)
        with self.assertRaisesRegex(latsch.InputError, "bar"):
            model[path] = "2 bar"
        with self.assertWarnsRegex(UserWarning, "is taken in N/m, but a joint's stiffness is usually"):
            copy.copy()[path] = 12.3
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "changed.toml"
            file.write_text(model.text())
            changed = latsch.test(model, SIDE_FORCE)
            self.assert_same_bits(latsch.test(latsch.read_model(file), SIDE_FORCE), (dict(changed), changed.units))
        self.assertNotEqual(changed["toe"][0], before["toe"][0])
        # The specimen that is kept between tests does not affect later results, and copies of a model are
        # independent.
        model[path] = copy[path]
        self.assert_same_bits(latsch.test(model, SIDE_FORCE), (dict(before), before.units))
        self.assert_same_bits(latsch.test(copy, SIDE_FORCE), (dict(before), before.units))

    def test_slopes_are_the_limits_of_differences(self):
        model = latsch.read_model(CORNER)
        paths = ["bushing.lbj.y", "bushing.lca_rear.y"]
        found = latsch.test(model, SIDE_FORCE, slopes=paths)
        self.assertEqual(found.paths, paths)
        self.assertEqual(found.slopes["toe"].shape, (5, 2))
        for column, path in enumerate(paths):
            def difference(h):
                sides = []
                for sign in (1, -1):
                    moved = model.copy()
                    moved[path] *= 1 + sign * h
                    sides.append(latsch.test(moved, SIDE_FORCE)["toe"])
                return (sides[0] - sides[1]) / (2 * h * model[path])
            exact, errors = found.slopes["toe"][:, column], []
            for h in (4e-2, 2e-2):
                errors.append(abs(difference(h) - exact)[0])
            self.assertAlmostEqual(np.log2(errors[0] / errors[1]), 2, delta=0.05)  # central differences are of order two
        plain = latsch.test(model, SIDE_FORCE)
        self.assert_same_bits(plain, (dict(found), found.units))

    def test_wrong_input_says_where_and_what(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "corner.toml"
            lines = CORNER.read_text().splitlines()
            lines.insert(3, "nonsense = 1")
            file.write_text("\n".join(lines))
            with self.assertRaises(latsch.InputError) as caught:
                latsch.test(file, SIDE_FORCE)
            self.assertEqual((caught.exception.file, caught.exception.line), (str(file), 4))
        for call in (lambda: latsch.read_model(CORNER)["bushing.lbj.w"],
                     lambda: latsch.test(CORNER, {"kind": "footprint"}),
                     lambda: latsch.test(CORNER, {"kind": "kc", "Fq": "1 kN"}),
                     lambda: latsch.test(CORNER, SIDE_FORCE, slopes=["bushing.lbj.w"]),
                     lambda: latsch.test(TIR, {"kind": "rolling_stiffness", "load": "4 kN", "speed": "60 km/h"},
                                         kind="magic_formula", slopes=["PKY1"]),
                     lambda: latsch.read_model(ROOT / "studies/compliance/study.toml"),
                     lambda: latsch.Score(value="a"),
                     lambda: latsch.read_model(CORNER, "bicycle")):
            with self.assertRaises(latsch.InputError):
                call()

    def test_a_test_that_does_not_succeed_raises_its_reason(self):
        with self.assertRaises(latsch.Failure) as caught:
            latsch.test(CORNER, {"kind": "kc", "Fy": "9000 kN"})
        self.assertEqual(caught.exception.cause, "point")
        self.assertTrue(caught.exception.reason)

    def test_tests_and_models_are_known(self):
        what, able = latsch.tests()["kc"]
        self.assertIn("suspension", able)
        self.assertTrue(what)
        self.assertEqual(latsch.read_model(CORNER).kind, "suspension")

    def test_other_threads_run_beside_a_test(self):
        with Meanwhile() as other:
            latsch.test(RING, OVER_A_CLEAT)
        self.assertGreater(other.turns, 20)

    def interrupted(self, model, test):
        """Returns the time, s, from Ctrl-C to the end of a process that repeats this test."""
        script = textwrap.dedent(f"""
            import sys, latsch
            model = latsch.read_model({str(model)!r})
            print("begins", flush=True)
            try:
                while True:
                    latsch.test(model, {test!r})
            except KeyboardInterrupt:
                print("interrupted", flush=True)
                sys.exit(7)
            """)
        run = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
        self.assertEqual(run.stdout.readline(), "begins\n")
        time.sleep(0.3)
        run.send_signal(signal.SIGINT)
        begin = time.monotonic()
        self.assertEqual(run.communicate(timeout=60)[0], "interrupted\n")
        self.assertEqual(run.returncode, 7)
        return time.monotonic() - begin

    def test_ctrl_c_is_answered_at_once(self):
        self.assertLess(self.interrupted(RING, OVER_A_CLEAT), 2)
        # Ctrl-C ends the process within seconds with its usual exit code, although the computation itself cannot be
        # stopped: it is abandoned.
        self.assertLess(self.interrupted(ROOT / "studies/tires/passenger_225_50R16.toml",
                                         {"kind": "modes", "pressure": "2.6 bar", "deflection": "25 mm"}), 2)


if __name__ == "__main__":
    unittest.main()
