#!/usr/bin/env python3
"""Tests the options that all verbs share: --json, --quiet, --log and help. No verb may print without regard to them.

   console_test.py PATH/TO/latsch"""
import json
import pathlib
import re
import subprocess
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, Coarse, edit

TREE = pathlib.Path(__file__).resolve().parents[3]
VERBS = ("new", "check", "mesh", "simulate", "doe", "run", "resume", "identify", "sample", "select", "design", "report", "export", "doctor",
         "process", "road", "test", "validate", "compare", "show", "help")


class Console(Coarse):
    def outputs(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout, run.stderr

    def answer(self, *arguments, code=DONE):
        """Runs the program and returns the JSON object that its standard output must be in any case; NaN and Infinity
        are not allowed."""
        def refuse(word):
            raise ValueError(f"{word} is not JSON")

        text, _ = self.outputs(*arguments, "--json", code=code)
        found = json.loads(text, parse_constant=refuse)
        self.assertEqual(found["exit_code"], code)
        self.assertEqual(found["verb"], arguments[0])
        self.assertIsInstance(found["warnings"], list)
        self.assertEqual("error" in found, code != DONE)
        return found["error"] if code != DONE else found["result"]

    def test_simulate_doe_run_identify_and_report_answer_a_program(self):
        edit(self.study, ("step_tolerance = .*", "step_tolerance = 0.1"))
        found = self.answer("simulate", self.study, "--set", "sidewall=5 N/mm^2")
        self.assertLess(found["target"], 1e-5)
        self.assertEqual(found["variables"][0], {"name": "sidewall", "value": 5.0, "unit": "N/mm^2"})
        forces, modes = found["experiments"][0]["forces"], found["experiments"][1]["modes"]
        self.assertEqual([round(d, 6) for d in forces["deflection_m"]], [0.006, 0.012])
        self.assertAlmostEqual(forces["simulated_N"][0] / forces["measured_N"][0], 1, places=5)
        self.assertEqual(len(modes), 6)
        self.assertEqual(len(self.answer("doe", self.study, "--levels", "2")["points"]), 4)
        found = self.answer("run", self.study)
        low, high = found["variables"][0]["interval"]
        self.assertTrue(low < found["variables"][0]["value"] < high)
        self.assertTrue(pathlib.Path(found["report"]).exists())
        self.assertEqual(self.answer("report", self.study)["target"], found["target"])
        self.assertEqual(self.answer("identify", self.study, "--short")["variables"], found["variables"])
        self.assertTrue(self.answer("doctor", self.study)["healthy"])

    def test_other_verbs_answer_a_program(self):
        check = self.answer("check", self.study)
        self.assertEqual([v["name"] for v in check["variables"]], ["sidewall", "carcass"])
        self.assertEqual(check["experiments"][0]["values"], 2)
        self.assertEqual(self.answer("mesh", self.study)["sectors"], 18)
        tire = self.folder / "found.toml"
        self.assertEqual(self.answer("export", self.study, "--model", tire)["files"], [str(tire)])
        tir = TREE / "studies" / "tire_model_comparison" / "magic_formula.tir"
        states = self.folder / "states.csv"
        states.write_text("Fz [kN],alpha [deg]\n4,2\n4,-2\n")
        steady = f'{{kind = "steady_states", states = "{states}"}}'
        channels = {c["name"]: c for c in self.answer("test", tir, steady)["channels"]}
        self.assertEqual((channels["Fy"]["unit"], len(channels["Fy"]["values"])), ("N", 2))
        self.assertEqual(self.answer("show", states)["kind"], "Table (CSV)")
        ring = TREE / "studies" / "ring_tires" / "passenger_205_55R16.toml"
        self.assertAlmostEqual(self.answer("test", ring, '{kind = "footprint", loads = ["4 kN"]}')["channels"][0]["values"][0],
                               4000, delta=5)

    def test_errors_are_answers_too(self):
        self.assertIn("did you mean", self.answer("runn", code=WRONG_INPUT)["message"])
        self.assertIn("no option", self.answer("run", self.study, "--wrkers", "2", code=WRONG_INPUT)["message"])
        edit(self.study, ('pressure = "2.4 bar"', 'pressure = "2.4 N"'))
        error = self.answer("check", self.study, code=WRONG_INPUT)
        line = next(i for i, text in enumerate(self.study.read_text().splitlines(), 1) if '"2.4 N"' in text)
        self.assertEqual((error["file"], error["line"]), (str(self.study), line))
        edit(self.study, ('pressure = "2.4 N"', 'pressure = "9 bar"'), ("values = .*", "values = [1]}"))
        (self.folder / "stiffness.csv").write_text("deflection [mm], force [N]\n104.5, 1\n")
        self.assertIn("message", self.answer("simulate", self.study, code=FAILED))

    def test_an_unknown_option_is_named_before_a_missing_argument(self):
        wrong = self.answer("run", "--hlep", code=WRONG_INPUT)
        self.assertIn('no option "--hlep", did you mean "--help"?', wrong["message"])
        wrong = self.answer("run", self.study, "--workers", "abc", code=WRONG_INPUT)
        self.assertIn('is "abc", expected a whole number from 1 to 1024', wrong["message"])

    def test_show_says_that_nothing_is_there(self):
        for name, why in (("nothing", "cannot be opened"), (".", "is a folder")):
            self.assertIn(why, self.answer("show", name, code=WRONG_INPUT)["message"])

    def test_quiet_says_nothing_and_data_are_data(self):
        self.assertEqual(self.outputs("check", self.study, "--quiet"), ("", ""))
        self.assertEqual(self.outputs("doe", self.study, "--levels", "2", "--quiet"), ("", ""))
        flat, points = self.folder / "flat.toml", self.folder / "points.csv"
        flat.write_text('kind = "flat"\n')
        points.write_text("x,y\n0,0\n")
        self.assertEqual(self.outputs("road", flat, points, "--quiet"), self.outputs("road", flat, points))
        self.assertIn("cannot be opened", self.outputs("check", self.folder / "no.toml", "--quiet", code=WRONG_INPUT)[1])

    def test_a_log_has_what_was_said_and_how_it_ended(self):
        log = self.folder / "latsch.log"
        said, _ = self.outputs("check", self.study, "--log", log)
        self.outputs("doe", self.study, "--levels", "2", "--quiet", "--log", log)
        edit(self.study, ('pressure = "2.4 bar"', 'pressure = "2.4 N"'))
        self.outputs("check", self.study, "--json", "--log", log, code=WRONG_INPUT)
        text = log.read_text()
        self.assertIn(said, text)
        self.assertIn("4 of 4 points succeeded", text)
        self.assertRegex(text, r"# \d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ latsch doe .*--levels 2")
        self.assertRegex(text, r'latsch: .*is "2.4 N"')
        self.assertEqual(re.findall("ended with exit code (.)", text), ["0", "0", "2"])
        self.assertIn("log file", self.outputs("check", self.study, "--log", self.folder, code=WRONG_INPUT)[1])

    def test_help_knows_every_verb(self):
        for verb in VERBS:
            text, _ = self.outputs("help", verb)
            self.assert_says(text, "--json", "--quiet", "--log", f"Usage: latsch {verb} ")
            self.assertEqual(text, self.outputs(verb, "--help")[0])
        self.assertEqual(self.outputs("help"), self.outputs("--help"))
        self.assertIn('did you mean "run"?', self.outputs("help", "rum", code=WRONG_INPUT)[1])

    def test_texts_are_answers_too(self):
        for line in (["help"], ["help", "run"], ["run", "--help"], ["--help"], ["--version"]):
            with self.subTest(line):
                self.assertEqual(self.answer(*line)["text"], self.outputs(*line)[0])
        self.assertRegex(self.answer("--version")["version"], r"^\d+\.\d+")
        self.assertTrue(self.answer("help", "study")["sections"])

    def test_json_may_stand_before_the_verb(self):
        for line in (["help", "run"], ["--version"], ["check", self.study]):
            behind, before = (json.loads(self.outputs(*order)[0]) for order in ([*line, "--json"], ["--json", *line]))
            self.assertEqual(before, behind)
            self.assertIn("result", before)
        self.assertEqual(self.outputs("--quiet", "check", self.study), ("", ""))
        found = json.loads(self.outputs("--json", code=WRONG_INPUT)[0])
        self.assertEqual((found["verb"], found["exit_code"], found["status"]), ("", WRONG_INPUT, "wrong input"))
        self.assertIn("subcommand", found["error"]["message"])

    def test_nothing_is_printed_past_the_console(self):
        # leaves out apps/exchange, a library that other programs load
        for file in (TREE / "apps/cli").rglob("*.cpp"):
            if file.name == "console.cpp":
                continue
            printed = re.search(r"fmt::print|printf\s*\(|std::(cout|cerr)", file.read_text())
            self.assertIsNone(printed, f"{file.name}: {printed and printed[0]}; cli/console/console.h says what to use")


if __name__ == "__main__":
    unittest.main()
