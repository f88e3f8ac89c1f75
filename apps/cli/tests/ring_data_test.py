#!/usr/bin/env python3
"""Tests that the study of `latsch new --ring-data` identifies the parameters of a flexible ring tire from measured
loads and modes.

   ring_data_test.py PATH/TO/latsch"""
import csv
import json
import pathlib
import re
import shutil
import subprocess
import tempfile
import tomllib
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT, assert_identifiability, edit

RING = pathlib.Path(__file__).resolve().parents[3] / "studies" / "ring_tires" / "passenger_205_55R16.toml"
PRESSED = '{kind = "load_deflection", deflections = ["10 mm", "18 mm", "26 mm"]}'
AIR = '{kind = "modes", count = 30}'
TYPES = ["torsional", "lateral", "radial"]  # index: the code of the type of mode in the channel
FACTORS = {"belt.mass": 1.2, "sidewall.radial.stiffness": 0.8, "sidewall.tangential.stiffness": 1.25,
           "sidewall.lateral.stiffness": 0.75, "sidewall.torsion": 1.5, "sidewall.progressivity": 1.5,
           "belt.pressure_width": 1.2, "belt.bending_in_plane": 2.0, "belt.bending_out_of_plane": 0.6,
           "sidewall.radial.damping": 0.7, "sidewall.tangential.damping": 1.4, "sidewall.lateral.damping": 1.3}


def number(ring, path):
    """Returns a number of a ring's file, without its unit."""
    for key in path.split("."):
        ring = ring[key]
    return float(str(ring).split()[0])


class RingData(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_ring_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, f"latsch {' '.join(map(str, arguments))}\n{run.stdout}{run.stderr}")
        return run

    def shown(self, model):
        """Returns the loads, and for each mode name the lowest frequency."""
        def rows(test):
            return list(csv.DictReader(self.latsch("test", model, test).stdout.splitlines()))
        frequencies = {}
        for row in rows(AIR):
            name = f"{TYPES[int(row['type [1]'])]} n={row['n [1]']}" if float(row["type [1]"]) < len(TYPES) else "other"
            frequencies[name] = min(frequencies.get(name, 1e9), float(row["frequency [Hz]"]))
        return [float(row["force [N]"]) for row in rows(PRESSED)], frequencies

    def fitted(self, model):
        """Makes a study with data simulated by a model, runs it, and returns its folder, which then contains the
        fitted ring."""
        study = self.folder / "ring" / "study.toml"
        self.latsch("new", study.parent, "--ring-data", model)
        found = json.loads(self.latsch("run", study, "--json").stdout)["result"]
        assert_identifiability(self, study.parent, [one["name"] for one in found["variables"]])
        self.latsch("export", study, "--model", study.parent / "fitted.toml")
        return study.parent

    def test_a_ring_shows_what_the_finite_element_tire_shows(self):
        self.latsch("new", self.folder / "fe", "--coarse")
        tire = self.folder / "fe" / "tire.toml"
        ring = self.fitted(tire)
        loads, frequencies = self.shown(tire)
        study = tomllib.loads((ring / "study.toml").read_text())["experiment"]
        asked = dict(zip(study["frequency"]["modes"], study["frequency"]["values"]))
        self.assertEqual(len(asked), 6)
        for name, value in [*zip(loads, study["load"]["values"]), *((frequencies[n], v) for n, v in asked.items())]:
            self.assertAlmostEqual(float(value.split()[0]) / name, 1.0, delta=1e-5)
        # A ring with nine parameters cannot reproduce the curvature of the load over deflection, so the tolerance is
        # wide.
        ring_loads, ring_frequencies = self.shown(ring / "fitted.toml")
        for own, shown in zip(loads, ring_loads):
            self.assertAlmostEqual(shown / own, 1.0, delta=0.04)
        for name in asked:
            self.assertAlmostEqual(ring_frequencies[name] / frequencies[name], 1.0, delta=0.01, msg=name)

    def test_the_losses_of_a_finite_element_tire_are_dampings_of_the_ring(self):
        self.latsch("new", self.folder / "fe", "--coarse")
        tire = self.folder / "fe" / "tire.toml"
        self.latsch("new", self.folder / "elastic", "--ring-data", tire)
        edit(tire, (r"(?m)^\[rubber\.(\w+)\]$", r"[rubber.\1]\nloss_factor = 0.15"))
        self.latsch("new", self.folder / "lossy", "--ring-data", tire)
        elastic, lossy = (tomllib.loads((self.folder / one / "study.toml").read_text()) for one in ("elastic", "lossy"))
        self.assertNotIn("damping", elastic["experiment"])
        self.assertEqual(lossy["experiment"]["damping"]["modes"], ["torsional n=0", "radial n=1", "lateral n=1"])
        for name in ("radial_damping", "tangential_damping", "lateral_damping"):
            self.assertIn(name, lossy["variable"])
        rows = list(csv.DictReader(self.latsch("test", tire, AIR.replace("}", ", damping = true}")).stdout.splitlines()))
        for experiment, channel in (("frequency", "frequency [Hz]"), ("damping", "damping [1]")):
            asked = lossy["experiment"][experiment]
            for mode, value in zip(asked["modes"], asked["values"]):
                kind, waves = mode.split(" n=")
                shown = next(row for row in rows if row["n [1]"] == waves and int(row["type [1]"]) == TYPES.index(kind))
                self.assertAlmostEqual(float(str(value).split()[0]) / float(shown[channel]), 1.0, delta=1e-5, msg=mode)
        # Moduli at the frequency of a mode exceed the relaxed ones, which the loads show.
        for relaxed, own in zip(elastic["experiment"]["frequency"]["values"], lossy["experiment"]["frequency"]["values"]):
            self.assertGreater(float(own.split()[0]), 1.02 * float(relaxed.split()[0]))
        self.assertEqual(elastic["experiment"]["load"]["values"], lossy["experiment"]["load"]["values"])
        self.latsch("check", self.folder / "lossy" / "study.toml")

    def test_the_numbers_of_a_known_ring_are_found_again(self):
        known = tomllib.loads(RING.read_text())
        text = RING.read_text()
        for path, factor in FACTORS.items():
            table, key = path.rsplit(".", 1)
            start = text.index(f"[{table}]")
            text = text[:start] + re.sub(rf"(?m)^({key} = \"?)([\d.]+)",
                                         lambda m: f"{m[1]}{float(m[2]) * factor:.8g}", text[start:], count=1)
        text = text.replace("\n[sidewall]\n", '\n[sidewall]\npressure_share = 0.62\nreference_pressure = "2.4 bar"\n')
        (self.folder / "truth.toml").write_text(text)
        found = tomllib.loads((self.fitted(self.folder / "truth.toml") / "fitted.toml").read_text())
        for path, factor in FACTORS.items():  # the data determine bending and torsion less accurately than the others
            self.assertAlmostEqual(number(found, path) / (factor * number(known, path)), 1.0, delta=0.02, msg=path)
        self.assertAlmostEqual(found["sidewall"]["pressure_share"], 0.62, delta=0.02)

    def test_a_known_ring_of_ones_own_is_where_the_fit_begins(self):
        own = self.folder / "own.toml"
        own.write_text(RING.read_text())
        edit(own, (r'mass = "[\d.]+ kg"', 'mass = "5 kg"'), ("progressivity = 1.2", "progressivity = 0"))
        self.latsch("new", self.folder / "ring", "--ring-data", RING, "--known", own)
        variables = tomllib.loads((self.folder / "ring" / "study.toml").read_text())["variable"]
        self.assertEqual(variables["mass"]["initial"], "5 kg")
        self.assertNotIn("progressivity", variables)  # this ring has no such parameter

    def test_a_second_pressure_is_that_of_a_tire_with_one(self):
        for text, words in (("[sidewall]  # per meter", True), ("[sidewall]", True), ('pressure = "0 bar"', False)):
            with self.subTest(text):
                own, to = self.folder / "own.toml", self.folder / f"ring{len(text)}"
                own.write_text(RING.read_text())
                edit(own, (r'(?m)^pressure = .*$', text) if not words else (r"(?m)^\[sidewall\]$", text))
                self.latsch("new", to, "--ring-data", own, "--known", own)
                study = tomllib.loads((to / "study.toml").read_text())
                self.assertEqual("soft" in study["test"], words)
                self.assertEqual("pressure_share" in study["variable"], words)
                self.assertEqual("pressure_share" in tomllib.loads((to / "ring.toml").read_text())["sidewall"], words)
                self.latsch("check", to / "study.toml")

    def test_frequencies_and_dampings_of_the_published_tire_are_met(self):
        study = self.folder / "ring" / "study.toml"
        self.latsch("new", study.parent, "--ring-data")
        edit(study, *((rf"(\[experiment\.{name}\])", r'\1\nuse = "predict"')
                      for name in ("load", "along", "across", "about")))
        self.latsch("run", study)
        self.latsch("export", study, "--model", study.parent / "fitted.toml")
        rows = list(csv.DictReader(self.latsch("test", study.parent / "fitted.toml", AIR).stdout.splitlines()))
        measured = tomllib.loads(study.read_text())["experiment"]
        for channel, experiment in (("frequency [Hz]", "frequency"), ("damping [1]", "damping")):
            for name, value in zip(measured[experiment]["modes"], measured[experiment]["values"]):
                kind, waves = name.split(" n=")
                shown = next(row for row in rows
                             if row["n [1]"] == waves and int(row["type [1]"]) == TYPES.index(kind))
                self.assertAlmostEqual(float(shown[channel]) / float(str(value).split()[0]), 1.0, delta=5e-3, msg=name)

    def test_what_is_missing_is_said(self):
        tir = self.folder / "tire.tir"
        tir.write_text("[MODEL]\nFITTYP = 61\n[DIMENSION]\nUNLOADED_RADIUS = 0.3\n[VERTICAL]\nFNOMIN = 4000\nVERTICAL_STIFFNESS = 2e5\n")
        for arguments, words in ((["--ring-data", "--known", RING], "no effect without --ring-data MODEL"),
                                 (["--ring-data", tir], "vibrates"),
                                 (["--ring-data", RING, "--known", self.folder / "none.toml"], "none.toml"),
                                 (["--ring-data", self.folder / "none.toml"], "none.toml")):
            with self.subTest(words):
                self.assertIn(words, self.latsch("new", self.folder / "ring", *arguments, code=WRONG_INPUT).stderr)
                self.assertFalse((self.folder / "ring").exists())


if __name__ == "__main__":
    unittest.main()
