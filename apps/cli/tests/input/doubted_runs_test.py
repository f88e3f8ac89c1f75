#!/usr/bin/env python3
"""Tests settings and results of a run that are misleading: a time limit that no trial can meet, trials that failed
without any message, two different numbers for the error of one experiment.

  doubted_runs_test.py PATH/TO/latsch"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, edit, served

STUDIES = pathlib.Path(__file__).resolve().parents[4] / "studies"
TIR = STUDIES / "tire_model_comparison" / "rigid_ring.tir"
STUDY = """model = "base.tir"
[test.pressed]
kind = "load_deflection"
deflections = ["5 mm", "10 mm", "20 mm", "32 mm"]
[variable.k]
path = "VERTICAL_STIFFNESS"
lower = "150 N/mm"
upper = "250 N/mm"
initial = "180 N/mm"
[experiment.c]
kind = "curve"
x = "pressed/deflection"
y = "pressed/force"
measurement = "m.csv"
exponent = 2
[experiment.d]
kind = "curve"
x = "pressed/deflection"
y = "pressed/force"
measurement = "n.csv"
[run]
timeout = "60 s"
"""


class DoubtedRuns(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_doubted_"))
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copy(TIR, self.folder / "base.tir")
        self.study = self.folder / "study.toml"
        self.study.write_text(STUDY)
        (self.folder / "m.csv").write_text("deflection [mm],force [N]\n10,1500\n20,4000\n30,7600\n")
        (self.folder / "n.csv").write_text("deflection [mm],force [N]\n10,1700\n20,3900\n25,5600\n")

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def answer(self, *arguments):
        run = subprocess.run([LATSCH, *map(str, arguments), "--json"], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, DONE, run.stdout + run.stderr)
        return json.loads(run.stdout)["result"]

    def test_a_limit_of_time_that_no_trial_keeps_is_doubted(self):
        self.assertNotIn("run.timeout", self.latsch("check", self.study))
        for written in ("1 us", "5 ms"):
            edit(self.study, ("timeout = .*", f'timeout = "{written}"'))
            self.assertRegex(self.latsch("check", self.study),
                             rf'study\.toml:\d+: run\.timeout is "{written}", but the time allowed to a trial is usually 0\.1')

    def test_the_limit_of_an_outside_program_is_doubted_as_well(self):
        study = self.folder / "outside.toml"
        (self.folder / "in.txt").write_text("{x}\n")
        (self.folder / "y.csv").write_text("y [1]\n0.5\n")
        study.write_text('[simulator]\ncommand = ["true"]\ninputs = ["in.txt"]\ntimeout = "1 us"\n'
                         '[simulator.output.out]\nfile = "out.csv"\nreader = "table"\nquantities = ["y [1]"]\n'
                         '[variable.x]\nlower = 0\nupper = 1\ninitial = 0.1\n'
                         '[experiment.e]\nkind = "curve"\ny = "out/y"\nmeasurement = "y.csv"\n[run]\ntimeout = "1 ms"\n')
        text = self.latsch("check", study)
        self.assertRegex(text, r'simulator\.timeout is "1 us", but the time allowed to a run')
        self.assertRegex(text, r'run\.timeout is "1 ms"')

    def test_an_experiment_has_one_number_everywhere(self):
        told = {one["name"]: one for one in self.answer("run", self.study)["experiments"]}
        text = self.latsch("run", self.study)
        trial = {one["name"]: one for one in self.answer("simulate", self.study, "--best")["experiments"]} \
            if "--best" in self.latsch("simulate", "--help") else None
        with served(self.folder) as page:
            view = {one["name"]: one for one in page.get("/api/study?study=study.toml")["experiments"]}
            best = page.get("/api/study?study=study.toml")["best"]["trial"]
            panel = {one["name"]: one for one in page.get(f"/api/trial?study=study.toml&trial={best}")["experiments"]}
            kpis = {one["experiment"]: one for one in page.get("/api/kpis?study=study.toml")["rows"]}
            both = {one["name"]: one for one in page.get("/api/compare?study=study.toml&other=study.toml")["experiments"]}
        report = (self.folder / "study.html").read_text()
        for name, measure in (("c", "RMS"), ("d", "mean")):
            error = told[name]["error"]
            self.assertEqual(told[name]["measure"], measure)
            self.assertNotAlmostEqual(error, 0.0, delta=1e-4)
            for other in (view[name], panel[name]) + ((trial[name],) if trial else ()):
                self.assertEqual(other["measure"], measure)
                self.assertAlmostEqual(other["error"], error, delta=1e-7)  # the page has seven digits
            self.assertEqual(kpis[name]["name"], measure + " error")
            self.assertAlmostEqual(kpis[name]["error"], error, delta=1e-7)  # the page has seven digits
            self.assertAlmostEqual(both[name]["errors"][0], error, delta=1e-7)  # the page has seven digits
            self.assertIn(f"{name}  ", text)
            self.assertRegex(text, rf"\n  {name} +fitted +{measure} {100 * error:.3g} %")
            self.assertRegex(report, rf"{measure} {100 * error:.2f}"[:-1])
        # the two measures differ in this test
        self.assertNotAlmostEqual(told["c"]["mean_error"], told["c"]["error"], delta=1e-4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
