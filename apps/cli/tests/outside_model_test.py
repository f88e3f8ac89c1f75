#!/usr/bin/env python3
"""Tests models other than finite-element tires: tables of tire states, outside programs; also a study on another file
system.

   outside_model_test.py PATH/TO/latsch"""
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from cli_testing import DONE, FAILED, LATSCH, STOPPED, WRONG_INPUT, Outside, edit, trials_of


class SteadyStates(Outside):
    """Tests a study of a steady-state tire with a table of states."""

    TIRE = """[MODEL]
FITTYP = 61
[DIMENSION]
UNLOADED_RADIUS = 0.3
[VERTICAL]
FNOMIN = 4000
VERTICAL_STIFFNESS = 200000
[VERTICAL_FORCE_RANGE]
FZMAX = 5000
[LATERAL_COEFFICIENTS]
PCY1 = 1.3
PDY1 = 1.0
PKY1 = -20
PKY2 = 1.5
"""

    @staticmethod
    def steady(states, *keys):
        return "{" + ", ".join(['kind = "steady_states"', f'states = "{states}"', *keys]) + "}"

    def test_forces_of_a_table_in_any_order_and_unit(self):
        tire, states, forces = (self.folder / name for name in ("tire.tir", "states.csv", "forces.csv"))
        tire.write_text(self.TIRE)
        states.write_text("alpha [deg],FZ [kN]\n90e-1,4\n-9,4\n2,9\n")
        self.latsch("test", tire, self.steady(states), "-o", forces)
        head, *rows = [line.split(",") for line in forces.read_text().splitlines()]
        Fy = [float(row[head.index("Fy [N]")]) for row in rows]
        self.assertLess(Fy[0], -3000)
        self.assertAlmostEqual(Fy[0], -Fy[1], places=8)
        self.assertEqual(float(rows[2][head.index("Fz [N]")]), 5000)  # limited
        self.latsch("test", tire, self.steady(states, 'limits = "off"'), "-o", forces)
        self.assertEqual(float(forces.read_text().splitlines()[3].split(",")[2]), 9000)

    def test_what_is_to_be_minded_is_said(self):
        tire, states, forces = (self.folder / name for name in ("tire.tir", "states.csv", "forces.csv"))
        tire.write_text(self.TIRE)
        states.write_text("Fz [N],wind [m/s]\n4000,1\n9000,1\n")
        said = self.latsch("test", tire, self.steady(states, 'turn_slip = "on"'), "-o", forces)
        self.assert_says(said, 'states.csv: column "wind" is not used', "1 of 2 states lie outside of the ranges",
                         'limits = "off"', "no turn slip coefficients")

    def test_a_long_table_is_answered_block_by_block(self):
        """Checks that a table longer than a block, and longer than the part kept in memory, gives the same results as
        its parts."""
        tire, states, forces = (self.folder / name for name in ("tire.tir", "states.csv", "forces.csv"))
        tire.write_text(self.TIRE)
        rows = [f"{2000 + k % 2999}.{k % 7}00000000,{k % 13 - 6}.500000000000" for k in range(20_000)]
        states.write_text("Fz [N],alpha [deg]\n" + "\n".join(rows) + "\n" + "#" * (17 << 20) + "\n")
        self.latsch("test", tire, self.steady(states), "-o", forces)
        whole = forces.read_text().splitlines()
        self.assertEqual(len(whole), 20_001)
        states.write_text("Fz [N],alpha [deg]\n" + "\n".join(rows[9_000:9_010]) + "\n")
        self.latsch("test", tire, self.steady(states), "-o", forces)
        self.assertEqual(forces.read_text().splitlines()[1:], whole[9_001:9_011])

    def test_what_is_wrong_is_named(self):
        tire, states = self.folder / "tire.tir", self.folder / "states.csv"
        tire.write_text(self.TIRE.replace("UNLOADED_RADIUS = 0.3\n", ""))
        states.write_text("Fz\n4000\n")
        self.assert_says(self.latsch("test", tire, self.steady(states), code=WRONG_INPUT), "tire.tir", "UNLOADED_RADIUS")
        tire.write_text(self.TIRE)
        states.write_text("kappa\n0\n")
        self.assert_says(self.latsch("test", tire, self.steady(states), code=WRONG_INPUT), "states.csv:1", "Fz")
        states.with_suffix(".tdx").write_text("**HEADER\n**END\n")
        self.assert_says(self.latsch("test", tire, self.steady(states.with_suffix(".tdx")), code=WRONG_INPUT),
                         'names "states.tdx", which ends as a recording, expected a table (.csv)')


class Simulators(Outside):
    def test_a_script_is_fitted(self):
        study = self.study("quarter_car")
        edit(study, ("step_tolerance = .*", "step_tolerance = 0.02"))
        self.assert_says(self.latsch("check", study), "python3 quarter_car.py", "30 values from step.csv")
        self.assert_says(self.latsch("simulate", study, "--set", "spring=25 N/mm", "--set", "damper=1600 N s/m"),
                         "mean |d| 0.00")
        text = self.latsch("run", study)
        self.assertAlmostEqual(self.found(text, "spring"), 25, delta=0.25)
        self.assertAlmostEqual(self.found(text, "damper"), 1600, delta=32)
        self.assert_says(text, "Report: ")
        self.assertFalse((study.parent / "study.scratch").exists())
        self.assert_says((study.parent / "study.html").read_text(), "In outside programs")

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX (ccx) is not installed")
    def test_calculix_is_fitted(self):
        text = self.latsch("run", self.study("cantilever_calculix"))
        # the mesh error is 0.1 %, and two digits are required
        self.assertAlmostEqual(self.found(text, "modulus"), 2.1e5, delta=2e3)

    def test_a_program_that_hangs_crashes_or_prints_nonsense_is_told_in_words(self):
        study = self.study("quarter_car")
        script = study.parent / "quarter_car.py"
        for text, said in (("import time; time.sleep(1000)", "took more than the 0.5 s"),
                           ("import os; os.abort()", "killed by signal 6"),
                           ("print('no license'); raise SystemExit(4)", 'exited with code 4; it last printed "no license"'),
                           ("open('response.csv', 'wb').write(bytes(range(256)))", "response.csv"),
                           ("open('response.csv', 'w').write('time [s],body [mm]\\n0,0\\n')", "reaches from 0 to 0 s")):
            script.write_text(text)
            # All scripts except the sleeping one end by themselves, so their time limit is long enough for a loaded
            # machine on which they start slowly.
            edit(study, ("timeout = .*", f'timeout = "{"0.5 s" if "1000" in text else "60 s"}"'))
            (study.parent / "study.latsch").unlink(missing_ok=True)
            edit(study, (r"\[optimizer\](\n.*)*?\n\n", '[optimizer]\nmax_steps = 1\n\n'))
            self.assert_says(self.latsch("run", study, code=FAILED), "no trial succeeded, of ", said, "latsch simulate")
            self.assertFalse((study.parent / "study.scratch").exists())

    def test_simulate_keeps_to_the_limits_of_run(self):
        study = self.study("quarter_car")
        script = study.parent / "quarter_car.py"
        script.write_text("import time; time.sleep(1000)")
        edit(study, ("timeout = .*", 'timeout = "0.5 s"'))
        self.assert_says(self.latsch("simulate", study, code=FAILED), "s allowed to it and was killed")
        script.write_text("bytearray(3_000_000_000)")
        edit(study, ("timeout = .*", 'timeout = "60 s"'))  # the study's memory is 1 GB
        self.assert_says(self.latsch("simulate", study, code=FAILED), "MemoryError")

    def test_a_program_that_is_not_installed_is_named_before_the_run(self):
        study = self.study("quarter_car")
        for program, said in (("pithon3", 'starts "pithon3", which is no program in PATH'),
                              ("{study}/absent", f'starts "{study.parent}/absent", which is no program there')):
            edit(study, (r'command = \["[^"]*"', f'command = ["{program}"'))
            self.assert_says(self.latsch("check", study, code=WRONG_INPUT), "study.toml: simulator.command", said)

    def test_a_failed_point_is_answered_as_the_study_asks_and_stays_a_failed_trial(self):
        for policy, said in (("recover", "counts as a target of 100 %"), ("continuation", "in 4 halvings")):
            study = self.study("quarter_car")
            edit(study, ("step_tolerance = .*", "max_steps = 15"), (r"\[run\]", f'[run]\nintervals = false\non_failure = "{policy}"'))
            edit(study.parent / "quarter_car.py", (r"    state = \(", '    assert car["damper"] > 1500, "too soft"\n    state = ('))
            self.assert_says(self.latsch("check", study), said)
            text = self.latsch("run", study)
            self.assertGreater(self.found(text, "damper"), 1500)
            report = (study.parent / "study.html").read_text()
            self.assert_says(report, "too soft")
            self.assert_says(self.latsch("doe", study, "--levels", "2"), "in a design a failed point just stays failed")
            shutil.rmtree(study.parent)

    def test_points_that_always_hang_expire_and_the_run_ends(self):
        (self.folder / "model.awk").write_text('{ if ($1 > 0.55) system("sleep 1000");'
                                               ' printf "y [1]\\n%.17g\\n", $1 - 0.6 > "out.csv" }\n')
        (self.folder / "in.txt").write_text("{x}\n")
        (self.folder / "measured.csv").write_text("y [1]\n0.5\n")
        study = self.folder / "study.toml"
        study.write_text('[simulator]\ncommand = ["awk", "-f", "{study}/model.awk", "in.txt"]\ninputs = ["in.txt"]\n'
                         '[simulator.output.out]\nfile = "out.csv"\nreader = "table"\nquantities = ["y [1]"]\n'
                         '[variable.x]\nlower = 0\nupper = 1\ninitial = 0.1\n'
                         '[experiment.e]\nkind = "curve"\ny = "out/y"\nmeasurement = "measured.csv"\n'
                         '[optimizer]\nmethod = "gss"\nstep_tolerance = 0.02\n'
                         '[run]\nworkers = 2\ntimeout = "0.7 s"\nintervals = false\nstraggler_factor = 2\n')
        begin = time.monotonic()
        text = self.latsch("run", study)
        self.assertLess(time.monotonic() - begin, 40.0)
        self.assertGreater(self.found(text, "x"), 0.5)
        self.assert_says((self.folder / "study.html").read_text(), "took more than the 0.7 s allowed")
        self.assertRegex(text, r"[1-9]\d* failed")
        self.assertRegex(text, r"\d+ of \d+ trials failed: \d+ because: took more than the 0\.7 s allowed.*raise timeout in \[run\]")
        self.assertRegex(self.latsch("check", study), r"trials failed: .*took more than the 0\.7 s allowed")

    def test_an_interrupt_also_ends_what_cannot_be_asked(self):
        """Checks a run that writes its report to a pipe that nobody reads."""
        study = self.study("quarter_car")
        edit(study, ("step_tolerance = .*", "max_steps = 3"), (r"\[run\]", "[run]\nintervals = false"))
        os.mkfifo(study.parent / "study.html")
        run = subprocess.Popen([LATSCH, "run", study], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.kill)
        while trials_of(study.parent / "study.latsch") < 3:
            self.assertIsNone(run.poll(), "the run ended before it was stopped")
            time.sleep(0.01)
        time.sleep(1.0)
        begin = time.monotonic()
        run.send_signal(signal.SIGINT)
        self.assertIn("what is in the journal is safe", run.communicate(timeout=10)[1])
        self.assertEqual(run.returncode, STOPPED)
        self.assertLess(time.monotonic() - begin, 2.0)

    def test_a_run_in_which_everything_fails_alike_ends_soon_and_goes_on_once_that_is_mended(self):
        study = self.study("quarter_car")
        script, journal = study.parent / "quarter_car.py", study.parent / "study.latsch"
        whole = script.read_text()
        edit(study, ("step_tolerance = .*", "step_tolerance = 0.02"), (r"\[run\]", "[run]\nintervals = false"),
             (r'"quarter_car.py", "car.txt"', '"{study}/licensed.py", "car.txt"'), (r'files = \["quarter_car.py"\]\n', ""))
        licensed = study.parent / "licensed.py"
        licensed.write_text("print('no license for 2 seats'); raise SystemExit(4)")
        text = self.latsch("run", study, code=FAILED)
        self.assert_says(text, "no trial succeeded", "no license", "nothing to do with the point", "--retry-failed")
        self.assertLess(trials_of(journal), 30)
        licensed.write_text(whole)  # this is another program, so trials of the old one are not reused
        self.assert_says(self.latsch("resume", study, code=WRONG_INPUT), "program files", "licensed.py", "--adopt", "--anew")
        # reading the journal is still allowed
        self.assert_says(self.latsch("report", study, code=FAILED), "succeeded")
        text = self.latsch("resume", study, "--adopt", "--retry-failed")
        self.assert_says(text, "failed points are tried again", "Report: ")
        self.assertAlmostEqual(self.found(text, "spring"), 25, delta=0.5)
        self.assert_says(self.latsch("run", study, "--anew"), "kept as", "study.1.latsch")

    def test_what_a_raised_timeout_concerns_is_tried_again_at_once(self):
        study = self.study("quarter_car")
        edit(study, ("step_tolerance = .*", "max_steps = 12"), (r"\[run\]", "[run]\nintervals = false"), ("timeout = .*", 'timeout = "0.6 s"'))
        edit(study.parent / "quarter_car.py", (r"    state = \(", '    if car["damper"] < 2500: import time; time.sleep(1.2)\n    state = ('))
        self.assertRegex(self.latsch("run", study), r"trials failed: .*took more than the 0\.6 s")
        self.assert_says((study.parent / "study.html").read_text(), "took more than the 0.6 s")
        edit(study, ("timeout = .*", 'timeout = "20 s"'))
        text = self.latsch("resume", study)
        self.assert_says(text, "failed at a limit which is now higher")
        self.assertNotIn("trials failed:", text)

    def test_stages_and_a_start_in_the_journal_survive_a_kill(self):
        study = self.study("quarter_car")
        edit(study, (r"\[optimizer\](\n.*)*?\n\n", """[doe]
design = "latin_hypercube"
points = 8

[optimizer]
start = "basins"
starts = 2

[stage.wide]
step_tolerance = 0.05

[stage.narrow]
bounds = 0.2
step_tolerance = 0.002

"""), (r"\[run\]", "[run]\nintervals = false"))
        self.assert_says(self.latsch("check", study), "wide", "bounds 0.2 as wide", "the 2 lowest minima of the design")
        def found(text):  # the results of every stage, without the number of trials in the journal
            return re.sub(r"\d+ (finished trials are reused|trials in )", "", text[text.index("Best of"):text.index("Report")])

        journal, held = study.parent / "study.latsch", self.folder / "held"
        script = study.parent / "quarter_car.py"
        # While the file `held` exists, no trial begins once the journal has as many trials as the file says. So a run
        # cannot end before it is killed, however slow the machine is.
        script.write_text(f"""import os, sqlite3, time
while os.path.exists({str(held)!r}):
    journal = sqlite3.connect("file:{journal}?mode=ro", uri=True)
    if journal.execute("select count(*) from trials").fetchone()[0] < int(open({str(held)!r}).read()):
        break
    time.sleep(0.02)
""" + script.read_text())
        whole = self.latsch("run", study)
        self.assert_says(whole, "Stage 1 of 2, wide", "Stage 2 of 2, narrow")
        for killed_at in (4, trials_of(journal) - 8):
            journal.unlink()
            held.write_text(str(killed_at))
            run = subprocess.Popen([LATSCH, "run", study], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while trials_of(journal) < killed_at and run.poll() is None:
                time.sleep(0.005)
            run.kill()
            self.assertEqual(run.wait(), -signal.SIGKILL)
            held.unlink()
            self.assertEqual(found(self.latsch("resume", study)), found(whole))
        self.assert_says(journal.with_suffix(".html").read_text(), "stage narrow, after wide")

    def test_there_is_no_model_to_export(self):
        for arguments in (("--vtu", "a.vtu"), ("--measurements",)):
            self.assert_says(self.latsch("export", self.study("quarter_car" if "--vtu" in arguments else
                                                              "cantilever_calculix"), *arguments, code=WRONG_INPUT),
                             "instead of a model")


class OnAnotherFileSystem(Outside):
    """Checks a study on a file system in user space (FUSE). It counts as a network file system, because the kind of
    its storage is unknown."""

    def setUp(self):
        super().setUp()
        behind, mount = self.folder / "behind", self.folder / "mount"
        behind.mkdir()
        mount.mkdir()
        if not shutil.which("bindfs"):
            self.skipTest("bindfs is not installed")
        made = subprocess.run(["bindfs", behind, mount], capture_output=True, text=True)
        if made.returncode != DONE:
            self.skipTest(f"no file system can be mounted here: {made.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", mount], check=True)
        self.folder = mount

    def test_there_is_no_shared_memory_one_writer_and_a_kill_costs_nothing(self):
        study = self.study("quarter_car")
        journal = study.parent / "study.latsch"
        edit(study, ("step_tolerance = .*", "max_steps = 30"), (r"\[run\]", "[run]\nintervals = false"))
        result, slow, script = re.compile(r"Best of .*?\n\n", re.S), self.folder / "slow", study.parent / "quarter_car.py"
        script.write_text(f"import os, time\nif os.path.exists({str(slow)!r}): time.sleep(0.5)\n" + script.read_text())
        self.assert_says(self.latsch("check", study), "study.latsch (FUSE: a rollback log")
        said = self.latsch("run", study)
        self.assert_says(said, "study.latsch lies on FUSE: a rollback log")
        whole = result.search(said)[0]
        journal.unlink()
        slow.touch()  # so that the run lasts until it is killed
        run = subprocess.Popen([LATSCH, "run", study], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        while trials_of(journal) < 5:
            self.assertIsNone(run.poll(), "the run ended before it was stopped")
            time.sleep(0.01)
        self.assert_says(self.latsch("run", study, code=WRONG_INPUT), f"in use by process {run.pid} on")
        self.assert_says(self.latsch("report", study), "Report: ")
        self.assertEqual([*study.parent.glob("*-shm"), *study.parent.glob("*-wal")], [])
        run.kill()
        run.wait()
        slow.unlink()
        self.assertEqual(result.search(self.latsch("resume", study))[0], whole)


if __name__ == "__main__":
    unittest.main()
