#!/usr/bin/env python3
"""Tests numbers without a unit, spectra beyond the recording, and signs and sizes that no tire has: each is refused
or reported by name, in studies, suites, `latsch process` and `latsch compare`.

   doubtful_data_test.py PATH/TO/latsch"""
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from cli_testing import DONE, LATSCH, WRONG_INPUT, Coarse

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
"""

SUITE = """[test.pressed]
kind = "load_deflection"
deflections = ["18.2 mm", "32.4 mm"]
[check.a]
kind = "values"
channel = "pressed/force"
of = "first"
value = "3015.5 N"
largest_error = "3 %"
source = "x"
"""

DRUM_TEST = """kind = "drum_cleat"
speed = "30 km/h"
load = "3.5 kN"
drum_diameter = "2.5 m"
run_in = "0.2 s"
duration = "0.2 s"
lead = "0.06 s"
step = "0.5 ms"
sample_step = "1 ms"
cleat = {height = "10 mm", length = "20 mm"}
"""

COMPARISON = """channels = ["Fx", "Fz"]
band = ["8 Hz", "200 Hz"]
[test.slow]
file = "drum.toml"
measurement = "measured.csv"
[tire.mf]
kind = "magic_formula"
file = "base.tir"
"""

RIG = """[channels]
force = "Fz"
[drum]
circumference = "6 m"
[plateaus]
speeds = ["30 km/h"]
[spectrum]
segment = "0.2 s"
band = ["10 Hz", "300 Hz"]
[run.a]
file = "r.csv"
"""

SPEED, CIRCUMFERENCE = 30 / 3.6, 6.0  # m/s, m


class Data(unittest.TestCase):
    assert_says = Coarse.assert_says

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_data_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def latsch(self, *arguments, code=DONE, **options):
        run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300, cwd=self.folder, **options)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr


class Shares(Data):
    def setUp(self):
        super().setUp()
        shutil.copy(TIR, self.folder / "base.tir")
        self.write("m.csv", "deflection [mm],force [N]\n10,1600\n20,3400\n30,5200\n")

    def checked(self, more, code=WRONG_INPUT):
        self.write("study.toml", STUDY + more)
        return self.latsch("check", "study.toml", code=code)

    def test_a_number_without_a_unit_is_no_noise_of_a_force(self):
        self.assert_says(self.checked("noise = 20\n"), "study.toml:15", "2000 %", '"20 N"', '"20 %"')
        self.assert_says(self.checked('noise = "20"\n'), "not a number with a unit", '"20 N + 2 %"')
        self.assert_says(self.checked('noise = "1000 %"\n'), "more than the measured value itself")
        self.checked('noise = "20 N"\n', code=DONE)
        self.checked("noise = 0.02\n", code=DONE)

    def test_a_scale_of_a_loss_without_noise_is_a_share(self):
        self.assert_says(self.checked('loss = "huber"\nloss_scale = 1.345\n'), "134.5 %", "expected")
        self.checked('noise = "20 N"\nloss = "huber"\nloss_scale = 1.345\n', code=DONE)
        self.checked('loss = "huber"\nloss_scale = "134.5 %"\n', code=DONE)

    def test_an_exponent_that_hides_every_error_is_refused(self):
        self.assert_says(self.checked("exponent = 1000\n"), "exponent", "10")
        self.checked("exponent = 10\n", code=DONE)

    def test_limits_of_a_suite_are_shares(self):
        for key in ("largest_error", "mean_error"):
            self.write("suite.toml", SUITE.replace('largest_error = "3 %"', f"{key} = 3"))
            said = self.latsch("validate", "base.tir", "suite.toml", code=WRONG_INPUT)
            self.assert_says(said, f"{key} is 3", "300 %", '"3 %"')
        self.write("suite.toml", SUITE.replace('"3 %"', '"300 %"'))
        self.latsch("validate", "base.tir", "suite.toml")

    def test_a_prior_is_a_share_or_has_a_unit(self):
        prior = 'prior = "200 N/mm"\nprior_sigma = 20\n'
        self.write("study.toml", STUDY.replace('initial = "180 N/mm"\n', 'initial = "180 N/mm"\n' + prior) + 'noise = "20 N"\n')
        self.assert_says(self.latsch("check", "study.toml", code=WRONG_INPUT), "prior_sigma", "2000 %")

    def test_a_share_of_a_prior_without_a_unit_has_two_meanings(self):
        mu = '[variable.mu]\npath = "LMUY"\nlower = 0.1\nupper = 30\ninitial = 1\nprior = 10\nprior_sigma = {}\n'
        noise = 'noise = "20 N"\n'
        self.assert_says(self.checked(noise + mu.format('"80 %"')), "may mean 0.8 or that share of the prior, 8")
        self.checked(noise + mu.format(0.8), code=DONE)
        self.checked(noise + mu.format(8), code=DONE)
        self.checked(noise + mu.format('"80 %"') + 'scale = "logarithmic"\n', code=DONE)

    def test_a_whole_number_is_no_variable(self):
        mode = '[variable.q]\npath = "use_mode"\nlower = 0\nupper = 100\ninitial = 14\n'
        self.assert_says(self.checked(mode), "use_mode", "whole number")
        mode = mode.replace('path = "use_mode"', 'paths = ["use_mode"]').replace("100", "20")
        self.assert_says(self.checked(mode), "use_mode", "whole number")

    def test_path_beside_paths_and_names_that_are_not_near(self):
        both = STUDY.replace('path = "VERTICAL_STIFFNESS"', 'path = "VERTICAL_STIFFNESS"\npaths = ["VERTICAL_STIFFNESS"]')
        self.write("study.toml", both)
        self.assert_says(self.latsch("check", "study.toml", code=WRONG_INPUT), "beside paths")
        self.write("study.toml", 'vary = ["FOO"]\n' + STUDY)
        self.assertNotIn("did you mean", self.latsch("check", "study.toml", code=WRONG_INPUT))
        self.write("study.toml", STUDY.replace("base.tir", "http://x/base.tir"))
        self.assert_says(self.latsch("check", "study.toml", code=WRONG_INPUT), '"http://x/base.tir"')

    def test_a_low_pass_needs_a_record(self):
        self.write("t.csv", "time [s],Fz [N]\n" + "".join(f"{i / 500},{4000 + i % 7}\n" for i in range(61)))
        measurement = '[measurement.run]\nfile = "t.csv"\nlow_pass = "{}"\n'
        self.assert_says(self.checked(measurement.format("0.01 Hz")), "needs a record of 100 s")
        self.assert_says(self.checked(measurement.format("300 Hz")), "has to be below 250 Hz")
        self.checked(measurement.format("50 Hz"), code=DONE)

    def test_a_refined_test_has_to_reach_over_the_measurement(self):
        said = self.checked('[refined.test.pressed]\nkind = "load_deflection"\ndeflections = ["1 mm", "2 mm"]\n')
        self.assert_says(said, "[refined]", "make the test longer")

    def test_a_kind_that_is_not_in_a_tir_file(self):
        for kind in ("ring_tire", "fe_tire", "car"):
            said = self.latsch("test", "base.tir", '{kind = "load_deflection", deflections = ["9 mm"]}', "--kind", kind,
                               code=WRONG_INPUT)
            self.assert_says(said, "base.tir: is a .tir file", "rigid_ring or magic_formula")
        self.write("study.toml", STUDY.replace('model = "base.tir"\n', '[model]\nfile = "base.tir"\nkind = "ring_tire"\n'))
        self.assert_says(self.latsch("check", "study.toml", code=WRONG_INPUT), "rigid_ring or magic_formula")

    def test_an_exported_model_has_the_ending_of_its_kind(self):
        ring = STUDIES / "ring_tires" / "passenger_205_55R16.toml"
        for model, name in ((ring, "x.tir"), ("base.tir", "x.toml"), (ring, "x.csv"), ("base.tir", "x")):
            self.assert_says(self.latsch("export", model, "--model", name, code=WRONG_INPUT), name, "ends in")
            self.assertFalse((self.folder / name).exists())
        self.latsch("export", "base.tir", "--model", "x.TIR")
        self.assertIn("[MDI_HEADER]", self.latsch("export", "base.tir", "--model", "/dev/stdout"))

    def test_an_export_keeps_what_only_other_programs_read(self):
        text = (self.folder / "base.tir").read_text()
        text = text.replace("[LATERAL_COEFFICIENTS]", "[LATERAL_COEFFICIENTS]\nPDYY1 = 2 $ mine")
        text += "\n[SHAPE]\n{radial width}\n1.0 0.0\n1.0 0.4\n0.9 1.0\n[OTHERS]\nNAME = 'slick'\n"
        self.write("more.tir", text)
        self.assertNotIn("comment in the exported file", self.latsch("export", "more.tir", "--model", "out.tir"))
        out = (self.folder / "out.tir").read_text()
        self.assertRegex(out, r"PDYY1 +=? 2 +\$ mine\n")
        self.assertIn("[SHAPE]\n{RADIAL WIDTH}\n1.0 0.0\n1.0 0.4\n0.9 1.0\n", out)
        self.assertRegex(out, r"\[OTHERS\]\nNAME += 'slick'")
        lateral = out[out.index("[LATERAL_COEFFICIENTS]"):]
        self.assertIn("PDYY1", lateral[:lateral.index("\n[")])
        self.latsch("export", "out.tir", "--model", "again.tir")
        self.assertEqual((self.folder / "again.tir").read_text(), out)

    def test_what_an_export_cannot_convert_is_a_comment_and_named(self):
        text = (self.folder / "base.tir").read_text().replace("FORCE = 'newton'", "FORCE = 'kN'")
        text = text.replace("[LATERAL_COEFFICIENTS]", "[LATERAL_COEFFICIENTS]\nPDYY1 = 2")
        for key in ("FNOMIN", "VERTICAL_STIFFNESS", "VERTICAL_DAMPING", "LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS",
                    "YAW_STIFFNESS"):
            text = re.sub(rf"(?m)^({key} *= *)(\S+)", lambda m: f"{m[1]}{float(m[2]) / 1000!r}", text)
        self.write("kilo.tir", text + "[SHAPE]\n{radial width}\n1.0 0.0\n0.9 1.0\n")
        self.assert_says(self.latsch("export", "kilo.tir", "--model", "out.tir"), "PDYY1 is a comment in the exported file")
        out = (self.folder / "out.tir").read_text()
        self.assertRegex(out, r"\$ kept from kilo.tir, in its units: .*FORCE = kN.*\n\$ PDYY1 += 2")
        self.assertIn("[SHAPE]\n{RADIAL WIDTH}\n1.0 0.0", out)

    def test_a_pipe_is_refused_where_a_file_is_read_more_than_once(self):
        self.write("study.toml", STUDY)
        os.mkfifo(self.folder / "pipe.tir")
        os.mkfifo(self.folder / "pipe.csv")
        for arguments in (["check", "pipe.tir"], ["show", "pipe.csv"], ["test", "pipe.tir", "{}"], ["compare", "pipe.csv"],
                          ["export", "pipe.tir", "--model", "x.tir"]):
            with self.subTest(arguments):
                self.assert_says(self.latsch(*arguments, code=WRONG_INPUT), "is a pipe", "expected a file")
        for verb in ("check", "run"):
            self.assert_says(self.latsch(verb, "/dev/stdin", code=WRONG_INPUT, input=STUDY), "is a pipe")

    def test_a_delay_without_room_is_known_before_the_first_trial(self):
        study = STUDY.replace('model = "base.tir"', '[model]\nkind = "rigid_ring"\nfile = "base.tir"')
        study = re.sub(r"(?s)\[test.pressed\].*?\[variable", "[test.rig]\n" + DRUM_TEST + "[variable", study)
        study = study.replace("pressed/deflection", "rig/time").replace("pressed/force", "rig/Fz").replace("m.csv", "fz.csv")
        self.write("study.toml", study + 'nuisance = {delay = "free"}\n')
        for cut, code in ((0, WRONG_INPUT), (5, DONE)):  # the test records from -59 to 140 ms
            rows = [f"{0.001 * k:.3f},{3500 + k % 7}" for k in range(-59 + cut, 141 - cut)]
            self.write("fz.csv", "time [s],Fz [N]\n" + "\n".join(rows) + "\n")
            said = self.latsch("check", "study.toml", code=code)
            self.assertEqual("leaves no room" in said, code == WRONG_INPUT, said)
        self.write("fz.csv", "time [s],Fz [N]\n" + "\n".join(f"{0.001 * k:.3f},3500" for k in range(-59, 141)) + "\n")
        self.assert_says(self.latsch("run", "study.toml", code=WRONG_INPUT), "study.toml:", "nuisance", "make the test longer")

    def test_no_command_waits_for_a_pipe_in_place_of_a_file(self):
        for name in ("p.csv", "p.toml", "p.latsch", "p.log", "p.tdx"):
            os.mkfifo(self.folder / name)
        self.write("measured.toml", STUDY.replace("m.csv", "p.csv"))
        self.write("recorded.toml", STUDY.replace('"m.csv"', '"rec"') + '[measurement.rec]\nfile = "p.tdx"\n')
        self.write("kept.toml", STUDY + '[run]\njournal = "p.latsch"\n')
        self.write("road.toml", 'kind = "flat"\n')
        self.write("rig.toml", RIG.replace("r.csv", "p.csv"))
        states = '{kind = "steady_states", states = "p.csv"}'
        for arguments in (["check", "measured.toml"], ["run", "measured.toml"], ["check", "recorded.toml"],
                          ["check", "kept.toml"], ["run", "kept.toml"], ["doctor", "p.latsch"], ["show", "p.tdx"],
                          ["test", "base.tir", states], ["test", "base.tir", "p.toml"], ["validate", "base.tir", "p.toml"],
                          ["road", "p.toml", "m.csv"], ["road", "road.toml", "p.csv"], ["process", "p.toml"],
                          ["process", "rig.toml"], ["serve", "p.toml", "--no-browser"], ["report", "p.toml"],
                          ["mesh", "p.toml"], ["new", "mf", "--magic-formula", "p.csv"],
                          ["new", "drum", "--drum", "p.csv", "--cleat", "10 mm x 20 mm"]):
            with self.subTest(arguments):
                run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=60, cwd=self.folder)
                self.assertEqual(run.returncode, WRONG_INPUT, run.stderr)
                self.assertIn("pipe", run.stderr)

    def test_a_journal_of_another_study_is_a_warning_of_check(self):
        self.write("study.toml", STUDY)
        self.latsch("run", "study.toml", "--quiet")
        text = (self.folder / "base.tir").read_text()
        self.write("base.tir", re.sub(r"(?m)^UNLOADED_RADIUS *= *[0-9.]+", "UNLOADED_RADIUS = 0.33", text))
        said = self.latsch("check", "study.toml")
        self.assert_says(said, "was made otherwise", "--anew")
        self.assertNotIn("Everything is in order", said)

    def test_a_damaged_journal_names_the_doctor(self):
        self.write("study.toml", STUDY)
        self.latsch("run", "study.toml", "--quiet")
        journal = self.folder / "study.latsch"
        data = journal.read_bytes()
        journal.write_bytes(data[:len(data) // 2])
        for verb in ("run", "report"):
            run = subprocess.run([LATSCH, verb, "study.toml"], capture_output=True, text=True, timeout=300, cwd=self.folder)
            self.assertNotEqual(run.returncode, DONE)
            self.assertIn("--salvage", run.stdout + run.stderr)


class Comparison(Data):
    def setUp(self):
        super().setUp()
        shutil.copy(TIR, self.folder / "base.tir")
        self.write("drum.toml", DRUM_TEST)
        self.latsch("test", "base.tir", "drum.toml", "--kind", "rigid_ring", "-o", "all.csv")
        lines = (self.folder / "all.csv").read_text().splitlines()
        heads = [head.split(" [")[0] for head in lines[0].split(",")]
        self.head = "time [s],Fx [N],Fz [N]"
        columns = [heads.index(name) for name in ("time", "Fx", "Fz")]
        self.rows = [[float(line.split(",")[k]) for k in columns] for line in lines[1:]]

    def compare(self, rows=None, head=None, comparison=COMPARISON, code=DONE):
        rows = self.rows if rows is None else rows
        self.write("measured.csv", "\n".join([head or self.head] + [",".join(f"{x:.6g}" for x in row) for row in rows]) + "\n")
        self.write("comparison.toml", comparison)
        return self.latsch("compare", "comparison.toml", code=code)

    def test_spectra_end_at_half_the_rate_of_the_recording(self):
        self.assertNotIn("was recorded", self.compare())
        slow = self.rows[::10]
        said = self.compare(slow + [[slow[-1][0] + 0.01, *self.rows[-1][1:]]])
        self.assert_says(said, "nothing above 50 Hz was recorded")
        for line in said.splitlines():
            self.assertNotRegex(line, r"to (5[7-9]|[6-9]\d|[12]\d\d) Hz;")
        said = self.compare(comparison=COMPARISON.replace('"200 Hz"', '"2000 Hz"'))
        self.assert_says(said, "nothing above 500 Hz was recorded", "not to 2000 Hz")

    def test_a_band_without_a_line_is_refused(self):
        said = self.compare(comparison=COMPARISON.replace('["8 Hz", "200 Hz"]', '["0.001 Hz", "2 Hz"]'), code=WRONG_INPUT)
        self.assert_says(said, "no line", "5 Hz apart")
        said = self.compare(comparison=COMPARISON.replace('"8 Hz"', '"2 Hz"'))
        self.assert_says(said, "nothing below 5 Hz")
        said = self.compare(comparison=COMPARISON.replace('["8 Hz", "200 Hz"]', '["20.5 Hz", "21 Hz"]'), code=WRONG_INPUT)
        self.assert_says(said, "third-octave")

    def test_recordings_that_are_none_of_the_test(self):
        changed = lambda change: [change(i, *row) for i, row in enumerate(self.rows)]
        for what, rows, part in (("kN", changed(lambda i, t, x, z: (t, x, 1e3 * z)), "is it in N, kN or lbf?"),
                                 ("negative", changed(lambda i, t, x, z: (t, x, -z)), "is below 0"),
                                 ("zero", changed(lambda i, t, x, z: (t, 0, 0)), "nothing to compare"),
                                 ("constant", changed(lambda i, t, x, z: (t, x, 3500)), "nothing to compare"),
                                 ("twice", self.rows[:50] + self.rows[49:], "rising times"),
                                 ("gap", self.rows[:50] + self.rows[70:], "20 samples are missing"),
                                 ("none", [], "no row"), ("one", self.rows[:1], "one row")):
            with self.subTest(what):
                self.assert_says(self.compare(rows, code=WRONG_INPUT), "measured.csv", part)

    def test_a_spectrum_of_a_study_ends_at_half_the_rate(self):
        self.compare()
        study = ('model = {file = "base.tir", kind = "rigid_ring"}\n[test.drum]\nfile = "drum.toml"\n[variable.k]\n'
                 'path = "VERTICAL_STIFFNESS"\nlower = "150 N/mm"\nupper = "250 N/mm"\ninitial = "180 N/mm"\n'
                 '[experiment.c]\nkind = "curve"\nx = "drum/time"\ny = "drum/Fz"\nmeasurement = "measured.csv"\n'
                 'compare = "psd"\n')
        for more, part in (('band = ["5 Hz", "3000 Hz"]\n', "nothing above 500 Hz"), ('segment = "10 s"\n', "the record has 0.2 s")):
            self.write("study.toml", study + more)
            self.assert_says(self.latsch("check", "study.toml", code=WRONG_INPUT), part)
        self.write("study.toml", study + 'band = ["5 Hz", "500 Hz"]\nsegment = "0.2 s"\n')
        self.latsch("check", "study.toml")

    def test_channels_and_kinds(self):
        channels = 'channels = ["Fx", "Fz"]'
        for other, part in (("channels = []", "is empty"), ('channels = ["Fx", "Fx"]', "twice")):
            self.assert_says(self.compare(comparison=COMPARISON.replace(channels, other), code=WRONG_INPUT), part)
        wrong = COMPARISON.replace('"magic_formula"', '"ring_tire"')
        self.assert_says(self.compare(comparison=wrong, code=WRONG_INPUT), "rigid_ring or magic_formula")


def passages(rate, seconds=16.0, scale=1.0, circumference=CIRCUMFERENCE):
    """Returns rows of time, speed and Fz: an impact once in each turn of the drum, followed by a decaying oscillation
    of 40 Hz."""
    period = circumference / SPEED
    for i in range(int(rate * seconds)):
        time = i / rate
        after = math.fmod(time, period) - 0.2
        ring = 600 * math.exp(-after / 0.03) * math.sin(2 * math.pi * 40 * after) if after > 0 else 0.0
        yield time, SPEED, scale * (4000 + ring + 5 * math.sin(1234.5 * i))


class Rig(Data):
    def process(self, rig=RIG, code=DONE, rate=2000, **options):
        with open(self.folder / "r.csv", "w") as out:
            out.write("time [s],speed [m/s],Fz [N]\n")
            out.writelines(f"{t:.6f},{v:.4f},{F:.2f}\n" for t, v, F in passages(rate, **options))
        self.write("rig.toml", rig)
        return self.latsch("process", "rig.toml", code=code)

    def test_a_good_record_has_no_doubt(self):
        self.assertNotIn("latsch: ", self.process())

    def test_levels_end_at_half_the_rate(self):
        said = self.process(RIG.replace('"300 Hz"', '"3000 Hz"'))
        self.assert_says(said, "nothing above 1000 Hz")
        levels = (self.folder / "rig_processed" / "levels_a_30kph.csv").read_text()
        self.assertNotIn("-999", levels)
        self.assertLess(float(levels.splitlines()[-1].split(",")[0]), 1000)
        self.assert_says(self.process(rate=400), "nothing above 200 Hz")
        self.assert_says(self.process(RIG.replace('["10 Hz"', '["250 Hz"'), rate=400, code=WRONG_INPUT), "begins at 250 Hz")
        self.assert_says(self.process(RIG + '[passages]\nalign_below = "5000 Hz"\n'), "nothing is filtered for the alignment")

    def test_a_segment_has_to_hold_samples(self):
        self.assert_says(self.process(RIG.replace('"0.2 s"', '"0.0001 s"'), code=WRONG_INPUT), "0.2 samples", "expected")
        self.assert_says(self.process(RIG.replace('"0.2 s"', '"0.02 s"')), "50 Hz apart")
        self.assert_says(self.process(RIG.replace('"0.2 s"', '"5 s"'), code=WRONG_INPUT), "segment is 5 s", "lasts 0.72 s")

    def test_a_circumference_that_does_not_fit(self):
        self.assert_says(self.process(RIG.replace('"6 m"', '"12 m"')), "2 hits", "6 m")
        self.assert_says(self.process(RIG.replace('"6 m"', '"18 m"')), "3 hits", "6 m")
        self.assert_says(self.process(RIG.replace('"6 m"', '"5.2 m"')), "6 m", "not 5.2 m")

    def test_signs_and_sizes_of_the_force(self):
        self.assert_says(self.process(scale=1000, code=WRONG_INPUT), "channel Fz is", "kN", "no tire carries")
        self.assert_says(self.process(scale=-1), "below 0", "SAE")

    def test_speeds_margins_and_channels(self):
        for old, new, part in (('["30 km/h"]', '["30 km/h", "30 km/h"]', "twice"),
                               ('["30 km/h"]', '["30 km/h"]\nmargin = "100 km/h"', "margin"),
                               ('["30 km/h"]', '["30 km/h", "31 km/h"]\nmargin = "2 km/h"', "differ by less than the margin"),
                               ('force = "Fz"', 'force = "Fz"\nalso = ["Fz"]', "force already"),
                               ('force = "Fz"', 'force = "Fz"\nalso = ["Fx", "Fx"]', "twice")):
            with self.subTest(new):
                self.assert_says(self.process(RIG.replace(old, new), code=WRONG_INPUT), part)

    def test_a_record_too_slow_for_a_cleat(self):
        said = self.process(RIG.replace('"300 Hz"', '"16 Hz"').replace('"0.2 s"', '"0.6 s"'), rate=50)
        self.assert_says(said, "hardly one sample")

    def test_new_names_its_runs_and_leaves_no_half_written_file(self):
        self.process()
        for day in ("day1", "day2"):
            (self.folder / day).mkdir()
            shutil.copy(self.folder / "r.csv", self.folder / day / "run.csv")
        new = ["new", "nd", "--cleat", "10 mm x 20 mm", "--drum"]
        self.assert_says(self.latsch(*new, "r.csv", "r.csv", code=WRONG_INPUT), "given twice")
        self.assertFalse((self.folder / "nd").exists() and list((self.folder / "nd").iterdir()))
        self.latsch(*new, "day1/run.csv", "day2/run.csv")
        rig = (self.folder / "nd" / "rig.toml").read_text()
        self.assert_says(rig, "[run.day1_run]", "[run.day2_run]")
        with open(self.folder / "flat.csv", "w") as out:
            out.write("time [s],speed [m/s],Fz [N]\n")
            chance = random.Random(1)
            out.writelines(f"{i / 200},{SPEED},{chance.gauss(4000, 10):.2f}\n" for i in range(4000))
        self.latsch("new", "none", "--drum", "flat.csv", "--cleat", "10 mm x 20 mm", code=WRONG_INPUT)
        self.assertFalse((self.folder / "none" / "rig.toml").exists())

    def test_new_knows_the_names_of_laboratories(self):
        self.process()
        rows = (self.folder / "r.csv").read_text().split("\n", 1)[1]
        for number, names in enumerate(("Zeit [s],Geschwindigkeit [m/s],Radlast [N]", "t_s,Vx_mps,FZ_N")):
            (self.folder / f"n{number}.csv").write_text(names + "\n" + rows)
            self.latsch("new", f"named{number}", "--drum", f"n{number}.csv", "--cleat", "10 mm x 20 mm")
        with open(self.folder / "kph.csv", "w") as out:
            out.write("t_s,V_kph,FZ_N\n")
            for t, v, F in (row.split(",") for row in rows.splitlines()):
                out.write(f"{t},{3.6 * float(v):.5f},{F}\n")
        self.latsch("new", "kph", "--drum", "kph.csv", "--cleat", "10 mm x 20 mm")
        held = [re.findall(r"\d+ km/h", (self.folder / n / "rig.toml").read_text()) for n in ("named0", "kph")]
        self.assertEqual(*held)

    def test_new_doubts_a_diameter_of_two_turns(self):
        self.process()
        said = self.latsch("new", "nd", "--drum", "r.csv", "--cleat", "10 mm x 20 mm", "--drum-diameter", "3.82 m")
        self.assert_says(said, "caution", "2 hits")


class MagicFormula(Data):
    RECORDS = STUDIES / "race_tire_mf" / "cornering.csv"

    def setUp(self):
        super().setUp()
        if not self.RECORDS.exists():
            self.skipTest(f"{self.RECORDS} is missing")

    def new(self, *arguments, code=DONE):
        shutil.rmtree(self.folder / "mf", ignore_errors=True)
        said = self.latsch("new", "mf", "--magic-formula", self.RECORDS, *arguments, code=code)
        if code != DONE:
            self.assertFalse((self.folder / "mf").exists())
        return said

    def test_a_radius_that_no_tire_has(self):
        for radius in ("2 mm", "30 m", "203 m"):
            self.assert_says(self.new("--radius", radius, code=WRONG_INPUT), "--radius", "expected the radius of an unloaded tire")

    def test_an_assumed_stiffness_is_said(self):
        self.assert_says(self.new("--radius", "203 mm"), "assumed: VERTICAL_STIFFNESS")

    def test_what_is_held_out_and_called(self):
        said = self.new("--radius", "203 mm", "--hold-out", "p = 0 kPa .. 1000 kPa", code=WRONG_INPUT)
        self.assert_says(said, "holds every sample out", "p = 0 kPa .. 1000 kPa")
        self.assertNotIn("e-324", said)
        self.assert_says(self.new("--radius", "203 mm", "--column", "foo = Fy", code=WRONG_INPUT), '"foo" is no channel')

    def test_a_size_with_an_impossible_rim(self):
        said = self.latsch("new", "x", "--size", "275/35R1", code=WRONG_INPUT)
        self.assert_says(said, "275/35R1", "rim of 1 inches", "10 to 24 inches")


if __name__ == "__main__":
    unittest.main()
