#!/usr/bin/env python3
"""Tests suites of checks for a spring, whose forces are known in closed form, and for the flexible ring, compared
with published numbers.

   validate_test.py PATH/TO/latsch     (the program "spring" is in the same folder)"""
import json
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from cli_testing import DONE, FAILED, LATSCH, WRONG_INPUT, edit

SPRING = pathlib.Path(LATSCH).with_name("spring")
RINGS = pathlib.Path(__file__).resolve().parents[3] / "studies" / "ring_tires"

# F = 20 N/mm x + 300 N s/m 0.4 m/s: 160, 220, 300 N
PULL = 'kind = "pull"\nspeed = "0.4 m/s"\ntravels = ["2 mm", "5 mm", "9 mm"]\n'
TESTS = '[test.fast]\nfile = "fast.toml"\n'
FORCES = '[check.forces]\nkind = "values"\nchannel = "fast/force"\nvalues = ["200 N", "220 N", "240 N"]\nsource = "by hand"\n'
LAST = '[check.last]\nchannel = "fast/force"\nof = "last"\nsource = "drawing 7"\n'


class Validated(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_validate_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.model, self.suite = self.folder / "spring.toml", self.folder / "suite.toml"
        self.model.write_text('kind = "spring"\nstiffness = "20 N/mm"\ndamping = "300 N s/m"\n')
        (self.folder / "fast.toml").write_text(PULL)

    def run_it(self, *arguments, code, program=SPRING):
        run = subprocess.run([program, "validate", *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run

    def rows(self, suite, code):
        self.suite.write_text(suite)
        answer = json.loads(self.run_it(self.model, self.suite, "--json", code=code).stdout)["result"]
        self.assertEqual(answer["accepted"], code == DONE)
        return answer["checks"]

    def test_errors_are_those_of_the_experiment_and_limits_are_inclusive(self):
        # The errors are (200 - 160)/200 = 20 %, 0 and (240 - 300)/240 = -25 %: their mean magnitude is 15 %, the
        # largest 25 %.
        mean, largest = self.rows(TESTS + FORCES + 'mean_error = "15 %"\nlargest_error = "25 %"\n', DONE)
        self.assertAlmostEqual(mean["value"], 0.15, places=12)
        self.assertAlmostEqual(largest["value"], 0.25, places=12)
        mean, largest = self.rows(TESTS + FORCES + 'mean_error = "14.99 %"\nlargest_error = "25 %"\n', FAILED)
        self.assertEqual((mean["accepted"], largest["accepted"]), (False, True))

    def test_a_number_lies_between_its_bounds_or_on_them(self):
        for bounds, code in (('lower = "300 N"\nupper = "0.3 kN"\n', DONE), ('lower = "300.1 N"\n', FAILED),
                             ('upper = "299.9 N"\n', FAILED), ('lower = "0 N"\n', DONE)):
            row, = self.rows(TESTS + LAST + bounds, code)
            self.assertAlmostEqual(row["value"], 300, places=9)
            self.assertEqual((row["unit"], row["source"]), ("N", "drawing 7"))

    def test_the_console_and_the_page_show_value_limit_and_source(self):
        (self.folder / "forces.csv").write_text("travel [m],force [N]\n0.002,160\n0.005,220\n0.009,250\n")
        self.suite.write_text('title = "Spring & <damper>"\n' + TESTS + LAST + 'lower = "250 N"\nupper = "310 N"\n'
                              '[check.curve]\nkind = "curve"\nx = "fast/travel"\ny = "fast/force"\n'
                              'measurement = "forces.csv"\nlargest_error = "10 %"\nsource = "rig"\n')
        text = self.run_it(self.model, self.suite, code=FAILED).stdout
        self.assertRegex(text, r"\nlast +last fast/force +300 N +250 N \.\. 310 N +yes +drawing 7\n")
        self.assertRegex(text, r"\ncurve +largest error of fast/force +20 % +at most 10 % +NO +rig\n")
        self.assertIn("1 of 2 accepted", text)
        page = (self.folder / "suite.html").read_text()
        for part in ("Spring &amp; &lt;damper&gt;", "drawing 7", "250 N .. 310 N", "1 of 2", "<svg", ">no</span>"):
            self.assertIn(part, page)

    def test_a_study_is_validated_at_its_best_point(self):
        study = self.folder / "study.toml"
        study.write_text('model = "spring.toml"\n' + TESTS + '[variable.stiffness]\npath = "stiffness"\nlower = "5 N/mm"\n'
                         'upper = "60 N/mm"\ninitial = "20 N/mm"\n[experiment.last]\nkind = "values"\n'
                         'channel = "fast/force"\nof = "last"\nvalue = "390 N"\n')  # 30 N/mm
        self.suite.write_text(TESTS + LAST + 'lower = "389.9 N"\nupper = "390.1 N"\n')
        self.run_it(study, self.suite, code=FAILED)
        subprocess.run([SPRING, "run", study, "--quiet"], check=True)
        self.run_it(study, self.suite, code=DONE)

    def test_wrong_suites_are_refused_with_their_line(self):
        limit = 'largest_error = "5 %"\n'
        for suite, said in ((TESTS + LAST.replace("fast/force", "fast/forse") + 'upper = "1 N"\n', 'did you mean "fast/force"'),
                            (TESTS + LAST + 'upper = "3 mm"\n', "force"),
                            (TESTS + LAST + 'lower = "3 N"\nupper = "2 N"\n', "is above upper"),
                            (TESTS + LAST + 'equal = "3 N"\n', "leaves no room"),
                            (TESTS + LAST, "expected lower, upper"),
                            (TESTS + LAST + limit + 'upper = "2 N"\n', "expected kind"),
                            (TESTS + LAST.replace('source = "drawing 7"\n', 'upper = "2 N"\n'), "source is missing"),
                            (TESTS + FORCES, "largest_error = "),
                            (TESTS + FORCES + 'largest_error = "5 N"\n', "5 N"),
                            (TESTS + FORCES + limit + "weight = 2\n", "belongs in a study"),
                            (TESTS + FORCES + limit + 'lagest_error = "3 %"\n', 'did you mean "largest_error"'),
                            (TESTS + LAST.replace("drawing 7", "") + 'upper = "2 N"\n', "the source of the limit"),
                            (TESTS, "expected a suite"),
                            (TESTS + "[check]\n", "expected a suite"),
                            (FORCES + limit, "[test.")):
            self.suite.write_text(suite)
            error = self.run_it(self.model, self.suite, code=WRONG_INPUT).stderr
            self.assertRegex(error, r"suite\.toml:\d+: ")
            self.assertIn(said, error)

    def ring(self, *edits, code):
        for file in RINGS.iterdir():
            shutil.copy(file, self.folder)
        if edits:
            edit(*edits)
        return self.run_it(self.folder / "passenger_205_55R16.toml", self.suite, program=LATSCH, code=code)

    def test_the_ring_tire_is_the_published_one_within_the_stated_limits(self):
        self.assertIn("7 of 7 accepted", self.ring(code=DONE).stdout)
        page = (self.folder / "suite.html").read_text()
        self.assertEqual(page.count("<figure"), 2)  # a figure for the modes; single values are rows of a table
        for name in ("first_load", "second_load"):
            self.assertIn(f"<tr><td>{name}<", page.split('<section id="values">')[1])

    def test_a_test_that_fails_is_named_and_leaves_the_others(self):
        text = self.ring(self.folder / "standing.toml", ("5018 N", "900 kN"), code=FAILED).stdout
        self.assertRegex(text, r"lateral .* – .* NO .*\n +standing.*900000 N.*: .+\n")
        self.assertIn("4 of 7 accepted", text)

    def test_a_model_that_cannot_do_a_test_is_refused_with_those_that_can(self):
        self.ring(code=DONE)
        tir = RINGS.parent / "race_tire_mf" / "tire.tir"
        error = self.run_it(tir, self.suite, program=LATSCH, code=WRONG_INPUT).stderr
        self.assertRegex(error, r"suite\.toml:\d+: check\.rigid_modes\.kind .*Magic Formula.*ring_tire")


if __name__ == "__main__":
    unittest.main()
