#!/usr/bin/env python3
"""The program end to end on a coarse tire: new, export, check, simulate, doe, run, kill, resume, report; and bad input.

    cli_test.py PATH/TO/latsch
"""
import contextlib
import os
import pathlib
import re
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

LATSCH = sys.argv.pop(1) if len(sys.argv) > 1 else "latsch"

DONE, FAILED, WRONG_INPUT = 0, 1, 2


def edit(file, *replacements):
    text = file.read_text()
    for pattern, new in replacements:
        text, count = re.subn(pattern, new, text)
        assert count, f"{pattern} is not in {file}"
    file.write_text(text)


def trials_of(journal):
    """Trials a journal holds, read beside the run that writes it; 0 while there is none."""
    try:
        with contextlib.closing(sqlite3.connect(f"file:{journal}?mode=ro", uri=True)) as rows:
            return rows.execute("select count(*) from trials").fetchone()[0]
    except sqlite3.OperationalError:
        return 0


class Coarse(unittest.TestCase):
    """A study that `latsch new` wrote, on a few hundred elements, with measurements from the model itself."""

    template = None

    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        folder = cls.base / "template"
        subprocess.run([LATSCH, "new", folder], check=True, stdout=subprocess.DEVNULL)
        edit(folder / "tire.toml", ("meridional = .*", "meridional = 14"), ("sectors = .*", "sectors = 18"), (r"spacing = \[\[.*\n", ""),
             (r"sector_zones = .*\n", ""),
             ('young_modulus = "4 MPa"', 'young_modulus = "5 MPa"'))  # both sidewalls alike, as the variable has them
        edit(folder / "study.toml",
             (r"values = \[5, .*\]}", "values = [6, 12]}"),
             ("measured_modes = 10", "measured_modes = 6"),
             ('method = "auto"', 'method = "gss"'),  # slow enough to be stopped on the way
             ("step_tolerance = .*", "step_tolerance = 0.05"),
             (r"\[variable.belt\]\n(.+\n)*", ""))
        for name in ("stiffness.csv", "modes.csv"):
            (folder / name).unlink()
        subprocess.run([LATSCH, "export", folder / "study.toml", "--measurements"], check=True,
                       stdout=subprocess.DEVNULL)
        edit(folder / "study.toml", ('initial = "5 N/mm.2"', 'initial = "8 N/mm^2"'))
        cls.template = folder

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.base)

    def setUp(self):
        self.folder = self.base / self._testMethodName
        shutil.copytree(self.template, self.folder)
        self.study = self.folder / "study.toml"

    def latsch(self, *arguments, code=DONE, **options):
        run = subprocess.run([LATSCH, *arguments], capture_output=True, text=True, timeout=300, **options)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def assert_says(self, text, *parts):
        for part in parts:
            self.assertIn(part, text)


class GoodInput(Coarse):
    def test_check_says_what_it_understood(self):
        self.assert_says(self.latsch("check", self.study), "sidewall", "8 N/mm^2", "HEX8", "load-deflection at 2.4 bar",
                         "2 values from stiffness.csv", "Everything is in order")

    def test_simulate_prints_forces_and_modes(self):
        text = self.latsch("simulate", self.study, "--set", "sidewall=6 N/mm^2")
        self.assert_says(text, "6 N/mm^2", "measured N", "measured Hz", "mean |dF|", "mean |df|", "target")

    def test_a_twin_is_perfect_at_the_values_it_was_written_with(self):
        text = self.latsch("simulate", self.study, "--set", "sidewall=5 N/mm^2")
        self.assertLess(float(re.search(r"target ([\d.]+) %", text)[1]), 0.001)

    def test_run_ends_with_result_and_report(self):
        text = self.latsch("run", self.study)
        self.assert_says(text, "Best of", "target", "sidewall", "Report: ")
        report = pathlib.Path(re.search(r"Report: (.*)", text)[1])
        self.assertIn("<html", report.read_text()[:500])
        self.assert_says(self.latsch("report", self.study), str(report))

    def test_killed_and_resumed_gives_the_same_result(self):
        whole = self.latsch("run", self.study)
        (self.folder / "study.latsch").unlink()
        with self.running_with_trials(3) as run:
            run.kill()
        resumed = self.latsch("resume", self.study)
        self.assert_says(resumed, "finished trials are reused")
        result = re.compile(r"Best of .*?\n\nReport", re.S)
        self.assertEqual(result.search(whole)[0], result.search(resumed)[0])

    def test_interrupted_says_how_to_go_on(self):
        edit(self.study, ("step_tolerance = .*", "step_tolerance = 1e-9"))
        with self.running_with_trials(3) as run:
            run.send_signal(signal.SIGINT)
            text, _ = run.communicate(timeout=30)
        self.assertEqual(run.returncode, FAILED)
        self.assert_says(text, "Interrupted", "latsch resume")

    @contextlib.contextmanager
    def running_with_trials(self, finished):
        """A `latsch run` under way, entered once its journal holds as many trials."""
        journal = self.folder / "study.latsch"
        run = subprocess.Popen([LATSCH, "run", self.study], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            while trials_of(journal) < finished:
                self.assertIsNone(run.poll(), "the run ended before it was stopped")
                time.sleep(0.01)
            yield run
        finally:
            run.kill()
            run.communicate()

    def test_a_run_reuses_what_a_grid_evaluated(self):
        self.assert_says(self.latsch("doe", self.study, "--levels", "3"), "of 9 points succeeded", "Report: ")
        self.assert_says(self.latsch("run", self.study), "9 finished trials are reused")

    def test_a_fit_ends_with_intervals_and_identify_adds_verdicts_and_resumes(self):
        edit(self.study, ("step_tolerance = .*", "step_tolerance = 0.1"))
        text = self.latsch("run", self.study)
        self.assertRegex(text, r"carcass +[0-9.]+ GPa +95 %: .*GPa")
        trials = trials_of(self.folder / "study.latsch")
        text = self.latsch("identify", self.study, "--short")
        self.assert_says(text, "singular value", "Values and their confidence intervals, from 8 measured values")
        self.assertEqual(trials_of(self.folder / "study.latsch"), trials)  # the fit left them in the journal
        verdict = r"(sidewall|carcass) +(identifiable|one-sided|flat|several minima)"
        self.assertRegex(self.latsch("identify", self.study), verdict)
        self.assertIn("What the data determine", (self.folder / "study.html").read_text())
        trials = trials_of(self.folder / "study.latsch")
        self.assertRegex(self.latsch("identify", self.study, "--workers", "1"), verdict)
        self.assertEqual(trials_of(self.folder / "study.latsch"), trials)
        edit(self.study, ("timeout = .*", 'timeout = "10 min"\nintervals = false'))
        self.assertNotIn("95 %", self.latsch("run", self.study))

    def test_morris_prints_its_sensitivities_and_resumes(self):
        edit(self.study, (r'design = "full_factorial".*\nlevels = .*', 'design = "morris"\npoints = 6'))
        self.assert_says(self.latsch("doe", self.study), "Morris trajectories", "mu*", "sigma", "carcass")
        self.assert_says(self.latsch("doe", self.study), "Morris trajectories, 6 points; 6 finished trials")

    def test_doctor_finds_damage_and_saves_the_rest(self):
        self.latsch("doe", self.study, "--levels", "2")
        journal, saved = self.folder / "study.latsch", self.folder / "saved.latsch"
        self.assert_says(self.latsch("doctor", journal), "4 of 4 trials", "in order")
        with contextlib.closing(sqlite3.connect(journal)) as rows, rows:
            rows.execute("update trials set point = zeroblob(24) where number = 3")
        self.latsch("resume", self.study, code=FAILED)
        self.assert_says(self.latsch("doctor", journal, "--salvage", saved, code=FAILED), "3 of 4", "trials lost", ": 3\n")
        saved.replace(journal)
        self.assert_says(self.latsch("doe", self.study, "--levels", "2"), "3 finished trials")

    def test_a_failed_trial_ends_the_run_where_that_is_asked_for(self):
        edit(self.study, (r"\[run\]", '[run]\non_failure = "abort"'), ('pressure = "2.4 bar"', 'pressure = "900 bar"'))
        self.assert_says(self.latsch("run", self.study, code=FAILED), "Aborted", "900 bar", "It failed at")

    def test_export_writes_files_for_other_programs(self):
        tire, vtu, deck = (self.folder / name for name in ("identified.toml", "tire.vtu", "tire.inp"))
        self.latsch("export", self.study, "--tire", tire, "--vtu", vtu, "--ccx", deck, "--deflection", "8 mm",
                    "--modes", "3")
        self.assert_says(self.latsch("mesh", tire), "HEX8", "kg")
        self.assertIn("VTKFile", vtu.read_text()[:200])
        self.assertIn("*NODE", deck.read_text().upper())

    def test_every_verb_has_help_with_an_example(self):
        for verb in ("new", "check", "mesh", "simulate", "evaluate", "doe", "run", "resume", "identify", "report", "export", "doctor"):
            self.assert_says(self.latsch(verb, "--help"), "xample", f"latsch {verb}")


class Outside(unittest.TestCase):
    """Studies of the tree with an outside program in the model's place."""

    latsch = Coarse.latsch
    assert_says = Coarse.assert_says

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def study(self, name):
        source = pathlib.Path(__file__).resolve().parents[2] / "studies" / name
        shutil.copytree(source, self.folder / name, ignore=shutil.ignore_patterns("*.latsch*", "*.html", "*.scratch"))
        return self.folder / name / "study.toml"

    def found(self, text, variable):
        return float(re.search(rf"\n  {variable} +(\S+)", text)[1])


class Evaluate(Outside):
    """A steady-state tire on a table of states."""

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

    def test_forces_of_a_table_in_any_order_and_unit(self):
        tire, states, forces = (self.folder / name for name in ("tire.tir", "states.csv", "forces.csv"))
        tire.write_text(self.TIRE)
        states.write_text("alpha [deg],FZ [kN]\n90e-1,4\n-9,4\n2,9\n")
        self.latsch("evaluate", tire, states, "-o", forces)
        head, *rows = [line.split(",") for line in forces.read_text().splitlines()]
        Fy = [float(row[head.index("Fy [N]")]) for row in rows]
        self.assertLess(Fy[0], -3000)
        self.assertAlmostEqual(Fy[0], -Fy[1], places=8)
        self.assertEqual(float(rows[2][head.index("Fz [N]")]), 5000)  # limited
        self.latsch("evaluate", tire, states, "--limits", "off", "-o", forces)
        self.assertEqual(float(forces.read_text().splitlines()[3].split(",")[2]), 9000)

    def test_what_is_wrong_is_named(self):
        tire, states = self.folder / "tire.tir", self.folder / "states.csv"
        tire.write_text(self.TIRE.replace("UNLOADED_RADIUS = 0.3\n", ""))
        states.write_text("Fz\n4000\n")
        self.assert_says(self.latsch("evaluate", tire, states, code=WRONG_INPUT), "tire.tir", "UNLOADED_RADIUS")
        tire.write_text(self.TIRE)
        states.write_text("kappa\n0\n")
        self.assert_says(self.latsch("evaluate", tire, states, code=WRONG_INPUT), "states.csv:1", "Fz")


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
        self.assertAlmostEqual(self.found(text, "modulus"), 2.1e5, delta=2e3)  # mesh: 0.1 %; two digits are asked for

    def test_a_program_that_hangs_crashes_or_prints_nonsense_is_told_in_words(self):
        study = self.study("quarter_car")
        script = study.parent / "quarter_car.py"
        for text, said in (("import time; time.sleep(1000)", "took more than the 0.5 s"),
                           ("import os; os.abort()", "killed by signal 6"),
                           ("print('no license'); raise SystemExit(4)", 'exited with code 4; it last printed "no license"'),
                           ("open('response.csv', 'wb').write(bytes(range(256)))", "response.csv"),
                           ("open('response.csv', 'w').write('time [s],body [mm]\\n0,0\\n')", "reaches from 0 to 0 s")):
            script.write_text(text)
            edit(study, ("timeout = .*", 'timeout = "0.5 s"'))
            (study.parent / "study.latsch").unlink(missing_ok=True)
            edit(study, (r"\[optimizer\](\n.*)*?\n\n", '[optimizer]\nmax_steps = 1\n\n'))
            self.assert_says(self.latsch("run", study, code=FAILED), "no trial succeeded, of ", said, "latsch simulate")
            self.assertFalse((study.parent / "study.scratch").exists())

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

    def test_there_is_no_tire_to_export(self):
        for arguments in (("--vtu", "a.vtu"), ("--measurements",)):
            self.assert_says(self.latsch("export", self.study("quarter_car" if "--vtu" in arguments else
                                                              "cantilever_calculix"), *arguments, code=WRONG_INPUT),
                             "no tire")


@unittest.skipUnless(shutil.which("mpirun"), "Open MPI (mpirun) is not installed")
class Ranks(Outside):
    """The same below mpirun; its long form is ./bench.sh mpi_faults."""

    RESULT = re.compile(r"Best of .*?\n\n", re.S)

    def setUp(self):
        super().setUp()
        self.quarter_car = self.study("quarter_car")
        self.journal = self.quarter_car.parent / "study.latsch"
        edit(self.quarter_car, ("step_tolerance = .*", "max_steps = 30"), (r"\[run\]", "[run]\nintervals = false"))

    def job(self, *arguments, recovery=False):
        return ["mpirun", "--oversubscribe", "--allow-run-as-root", *(["--enable-recovery"] if recovery else []),
                "-n", "3", LATSCH, *arguments]

    def mpi(self, *arguments, code=DONE):
        run = subprocess.run(self.job(*arguments), capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def test_doe_and_identify_give_the_same_as_worker_processes(self):
        said = re.compile(r"(of 4 points|Values and) .*?\n\n", re.S)
        alone = {}
        for launch in (self.latsch, self.mpi):
            self.journal.unlink(missing_ok=True)
            for verb in (("doe", self.quarter_car, "--levels", "2"), ("identify", self.quarter_car, "--short")):
                text = said.search(launch(*verb))[0]
                self.assertEqual(text, alone.setdefault(verb, text))

    def test_a_job_that_cannot_begin_ends_and_says_why(self):
        self.assert_says(self.mpi("identify", self.quarter_car, code=WRONG_INPUT), "nothing to analyze")
        self.latsch("doe", self.quarter_car, "--levels", "2")
        edit(self.quarter_car, ('"quarter_car.py", "car.txt"', '"quarter_car.py", "./car.txt"'))
        self.assert_says(self.mpi("run", self.quarter_car, code=WRONG_INPUT), "another study")

    def test_a_rank_or_the_master_is_killed_and_the_resumed_result_is_the_same(self):
        alone = self.RESULT.search(self.latsch("run", self.quarter_car))[0]
        for victim in (1, 0):
            self.journal.unlink()
            job = subprocess.Popen(self.job("run", self.quarter_car), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while trials_of(self.journal) < 4:
                self.assertIsNone(job.poll(), "the job ended before it was disturbed")
                time.sleep(0.01)
            self.kill(victim)
            job.wait(timeout=30)
            kept = trials_of(self.journal)
            self.assertGreaterEqual(kept, 4)
            resumed = self.mpi("resume", self.quarter_car)
            self.assert_says(resumed, f"{kept} finished trials are reused")
            self.assertEqual(self.RESULT.search(resumed)[0], alone)

    def kill(self, rank):
        """kill -9 of `latsch run` on that rank of the job."""
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                words = (process / "cmdline").read_bytes().split(b"\0")
                if words[0] == b"mpirun" or not {b"run", bytes(self.quarter_car)} <= set(words):
                    continue
                if f"OMPI_COMM_WORLD_RANK={rank}".encode() in (process / "environ").read_bytes().split(b"\0"):
                    return os.kill(int(process.name), signal.SIGKILL)
        self.fail(f"there is no rank {rank}")


class OnAnotherFileSystem(Outside):
    """A study on a file system in user space, which counts as one of a network: nobody can tell what is behind it."""

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
        result = re.compile(r"Best of .*?\n\n", re.S)
        self.assert_says(self.latsch("check", study), "study.latsch (FUSE: a rollback log")
        whole = result.search(self.latsch("run", study))[0]
        journal.unlink()
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
        self.assertEqual(result.search(self.latsch("resume", study))[0], whole)


class BadInput(Coarse):
    def rejected(self, verb, *parts):
        text = self.latsch(verb, self.study, code=WRONG_INPUT)
        self.assert_says(text, *parts)

    def test_negative_thickness(self):
        edit(self.folder / "tire.toml", (r'\[0.0, "6 mm"\]', '[0.0, "-6 mm"]'))
        self.rejected("check", "tire.toml", "thickness")

    def test_cord_angle_in_newtons(self):
        edit(self.folder / "tire.toml", ('angle = "24 deg"', 'angle = "22 N"'))
        self.rejected("check", "tire.toml", 'layer.belt_1.angle is "22 N"', "deg")

    def test_inverted_mesh(self):
        edit(self.folder / "tire.toml", (r"\[67, 303.5\], \[84, 298\]", "[84, 303.5], [67, 304]"))
        self.rejected("check", "tire.toml", "contour")

    def test_path_that_does_not_exist(self):
        edit(self.study, ("layer.carcass.young_modulus", "layer.carcas.young_modulus"))
        self.rejected("check", "study.toml", "variable.carcass.path", "layer.carcass.young_modulus")

    def test_empty_measurement(self):
        (self.folder / "stiffness.csv").write_text("")
        self.rejected("check", "stiffness.csv")

    def test_nan_in_a_measurement(self):
        (self.folder / "stiffness.csv").write_text("deflection [mm], force [N]\n6, nan\n")
        self.rejected("check", "stiffness.csv:2")

    def test_study_that_does_not_exist(self):
        self.study.unlink()
        self.rejected("run", "study.toml")

    def test_nothing_to_resume(self):
        self.rejected("resume", "nothing to resume", "latsch run")

    def test_journal_of_another_study(self):
        self.latsch("doe", self.study, "--levels", "2")
        edit(self.folder / "tire.toml", ('angle = "24 deg"', 'angle = "26 deg"'))
        self.rejected("resume", "study.latsch", "model")
        self.rejected("report", "study.latsch", "model")

    def test_unknown_variable_on_the_command_line(self):
        text = self.latsch("simulate", self.study, "--set", "sidewal=5 MPa", code=WRONG_INPUT)
        self.assert_says(text, "sidewal", "did you mean", "sidewall")

    def test_pressure_that_the_wall_does_not_bear(self):
        edit(self.study, ('pressure = "2.4 bar"', 'pressure = "900 bar"'))
        text = self.latsch("simulate", self.study, code=FAILED)
        self.assert_says(text, "experiment", "900 bar")

    def test_full_disk(self):
        def small_files():  # every file ends at 40 kB, as on a disk that is full
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, 40_000))

        text = self.latsch("run", self.study, code=FAILED, preexec_fn=small_files)
        self.assert_says(text, "study.latsch")
        resumed = self.latsch("resume", self.study)  # nothing that was finished is lost or spoiled
        self.assert_says(resumed, "Best of")


class Files(unittest.TestCase):
    """Roads asked and files looked at."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_cli_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def latsch(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, *map(str, arguments)], capture_output=True, text=True, timeout=60)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def test_a_ring_tire_rolls_on_the_drum(self):
        tire = pathlib.Path(__file__).resolve().parents[2] / "studies" / "ring_tires" / "passenger_205_55R16.toml"
        test = self.write("test.toml", 'kind = "drum_cleat"\nspeed = "30 km/h"\nload = "3.5 kN"\n'
                                       'drum_diameter = "2.5 m"\nrun_in = "20 ms"\nlead = "20 ms"\n'
                                       'duration = "40 ms"\n[cleat]\nheight = "10 mm"\nlength = "20 mm"\n')
        rows = [line.split(",") for line in self.latsch("drum", tire, test).splitlines()]
        self.assertEqual(rows[0][:4], ["time [s]", "Fx [N]", "Fy [N]", "Fz [N]"])
        self.assertEqual(len(rows), 1 + 80)
        self.assertAlmostEqual(float(rows[1][3]), 3500, delta=300)

    def test_a_road_answers_with_height_normal_and_friction(self):
        road = self.write("road.toml", 'kind = "cleat"\nheight = "20 mm"\nlength = "50 mm"\nbevel = "10 mm"\n'
                                       'place = "1 m"\nobstacle_friction = 0.8\n')
        points = self.write("points.csv", "x [m],y [mm]\n0,0\n1,250\n0.98,0\n")
        rows = [line.split(",") for line in self.latsch("road", road, points).splitlines()]
        self.assertEqual(rows[0], ["x [m]", "y [m]", "z [m]", "nx [1]", "ny [1]", "nz [1]", "friction [1]"])
        self.assertEqual(rows[1][2:], ["0", "0", "0", "1", "1"])
        self.assertEqual(rows[2][1:3] + rows[2][6:], ["0.25", "0.02", "0.8"])
        self.assertAlmostEqual(float(rows[3][2]), 0.015)
        self.assertAlmostEqual(float(rows[3][3]), -(0.5 ** 0.5))  # 45 deg, rising ahead

    def test_a_kerb_becomes_a_file_of_triangles(self):
        kerb = self.write("kerb.toml", 'kind = "kerb"\nshape = "saw_tooth"\npitch = "800 mm"\nwidth = "800 mm"\n'
                                       'height = "25 mm"\ncount = 4\n')
        rdf = self.folder / "kerb.rdf"
        points = self.write("points.csv", "x [m],y [m]\n0.4,0.4\n")
        self.latsch("road", kerb, "--triangles", rdf)
        rows = [line.split(",") for line in self.latsch("road", rdf, points).splitlines()]
        self.assertAlmostEqual(float(rows[1][2]), 0.0125, places=6)
        self.assertIn("POINTS.csv", self.latsch("road", kerb, code=WRONG_INPUT))

    def test_a_drum_moves_with_the_time_of_a_point(self):
        road = self.write("drum.toml", 'kind = "drum"\ndiameter = "2 m"\nspeed = "1 m/s"\ncleats = 1\n'
                                       'height = "20 mm"\nlength = "50 mm"\nstarting_angle = "1 rad"\n')
        points = self.write("points.csv", "x [m],y [m],time [s]\n0,0,0\n0,0,1\n")
        rows = [line.split(",") for line in self.latsch("road", road, points).splitlines()]
        self.assertEqual(rows[1][2], "0")
        self.assertAlmostEqual(float(rows[2][2]), 0.02, delta=5e-4)

    def test_open_crg_answers_with_u_and_v_too(self):
        road = self.write("road.crg", "$ROAD_CRG\nreference_line_increment = 1\nreference_line_start_x = 10\n"
                                      "long_section_v_increment = 2\n$\n$KD_Definition\n#:LRFI\n"
                                      "D:long section 1,m\nD:long section 2,m\n$\n$$$$\n"
                                      " 0.0000000 0.1000000\n 0.0000000 0.1000000\n")
        points = self.write("points.csv", "x [m],y [m]\n10.5,0.5\n")
        rows = [line.split(",") for line in self.latsch("road", road, points).splitlines()]
        self.assertEqual(rows[0][7:], ["u [m]", "v [m]"])
        self.assertAlmostEqual(float(rows[1][2]), 0.075)
        self.assertEqual([float(cell) for cell in rows[1][7:]], [0.5, 0.5])
        self.assertIn("2 rows, 2 long sections", self.latsch("show", road))

    def test_show_says_what_was_read_and_draws_it(self):
        tydex = self.write("test.tdx", "**HEADER\n**CONSTANTS\n"
                                       "INFLPRES  Inflation pressure            bar       2.5\n**MEASURCHANNELS\n"
                                       "RUNTIME   Running time                  s         1\n"
                                       "FYW       Lateral force                 kN        1\n"
                                       "**MEASURDATA\n0 1.5\n0.1 NOTAVAIL\n0.2 -0.5\n**END\n")
        page = self.folder / "test.html"
        text = self.latsch("show", tydex, "--html", page)
        self.assertRegex(text, r"INFLPRES +2.5 bar +250000 Pa")
        self.assertRegex(text, r"FYW +kN +W ")
        self.assertRegex(text, r"FYW +N +3 +1 +-500 +500 +1500")
        self.assertRegex(self.latsch("show", tydex, "--axes", "sae"), r"FYW +N +3 +1 +-1500 +-500 +500")
        self.assertIn('expected "iso"', self.latsch("show", tydex, "--axes", "din", code=WRONG_INPUT))
        self.assertIn("<polyline", page.read_text())
        self.assertIn("FYW [N] over RUNTIME [s]", page.read_text())
        table = self.write("table.csv", "Fz [kN],t [ms]\n1,0\n2,5\n")
        self.assertRegex(self.latsch("show", table), r"Fz +N +2 +0 +1000 +1500 +2000")

    def test_a_table_with_texts_is_shown_as_written(self):
        text = self.latsch("show", self.write("kerbs.csv", "name,width [mm]\nexit,800\n"))
        self.assertRegex(text, r'no channels: .*kerbs.csv:2')
        self.assertRegex(text, r"exit +800")

    def test_bad_files_are_named_with_their_line(self):
        self.assertIn('expected ".crg"', self.latsch("show", self.write("a.xyz", ""), code=WRONG_INPUT))
        torso = self.write("torso.tdx", "**HEADER\n**MEASURCHANNELS\n")
        self.assertIn("torso.tdx:2", self.latsch("show", torso, code=WRONG_INPUT))
        points = self.write("points.csv", "x [m]\n0\n")
        road = self.write("road.toml", 'kind = "flat"\n')
        self.assertIn('column "y" is missing', self.latsch("road", road, points, code=WRONG_INPUT))
        bumpy = self.write("bumpy.rdf", "[MODEL]\nMETHOD = '2D'\nROAD_TYPE = 'hill'\n")
        self.assertIn("bumpy.rdf:3", self.latsch("road", bumpy, points, code=WRONG_INPUT))


class Drum(unittest.TestCase):
    """`latsch process` on the example of studies/drum_processing, with short plateaus."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="latsch_drum_"))
        cls.rig = cls.folder / "rig.toml"
        shutil.copy(pathlib.Path(__file__).parents[2] / "studies/drum_processing/rig.toml", cls.rig)
        edit(cls.rig, ('hold = "20 s"', 'hold = "8 s"'), ("bootstrap = 100", "bootstrap = 5"))
        cls.first = subprocess.run([LATSCH, "process", cls.rig, "--synthetic"], capture_output=True, text=True,
                                   timeout=300)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def process(self, *arguments, code=DONE):
        run = subprocess.run([LATSCH, "process", *arguments], capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def test_one_command_from_recordings_to_tables_and_page(self):
        self.assertEqual(self.first.returncode, DONE, self.first.stdout + self.first.stderr)
        text = self.first.stdout
        f, true_f = (float(v) for v in re.findall(r"rig.*f = ([\d.]+) Hz", text))
        self.assertLess(abs(f - true_f), 0.005 * true_f)
        time, psd = zip(*((int(a), int(b)) for a, b in re.findall(r"([+-]\d+)%.*?([+-]\d+)%", text)))
        self.assertEqual(len(time), 6)
        self.assertLess(max(time + psd), -50)  # the filter helps on every case, fitted or not
        page = pathlib.Path(re.search(r"Report: (.*)", text)[1])
        self.assertIn("<svg", page.read_text())
        self.assertIn("frequency [Hz]", (page.parent / "psd_light_real_60kph.csv").read_text())

    def test_again_gives_the_same_tables(self):
        self.process(self.rig, "--output", self.folder / "again")
        for file in (self.folder / "rig_processed").iterdir():
            self.assertEqual(file.read_bytes(), (self.folder / "again" / file.name).read_bytes(), file.name)

    def test_a_mat_file_says_the_same_as_the_table(self):
        script = ("import numpy, scipy.io, sys; t = numpy.loadtxt(sys.argv[1], delimiter=',', skiprows=1).T; "
                  "scipy.io.savemat(sys.argv[2], dict(time=t[0], speed=t[1], Fz=t[2], Fx=t[3], comment='rig', n=3.0))")
        table, mat = self.folder / "light_dummy.csv", self.folder / "light_dummy.mat"
        if subprocess.run(["/usr/bin/python3", "-c", script, table, mat], capture_output=True).returncode:
            self.skipTest("SciPy is not installed (Debian: python3-scipy)")
        rig = self.folder / "mat.toml"
        rig.write_text(self.rig.read_text())
        edit(rig, ('"light_dummy.csv"', '"light_dummy.mat"'),
             (r"\[drum\]", '[channels.units]\ntime = "s"\nspeed = "m/s"\nFz = "N"\nFx = "N"\n[drum]'))
        self.process(rig)
        name = "average_light_dummy_60kph.csv"
        self.assertEqual((self.folder / "mat_processed" / name).read_text(),
                         (self.folder / "rig_processed" / name).read_text())

    def test_recordings_that_make_no_sense(self):
        bad = self.folder / "bad.toml"
        for pattern, new, *parts in (
                ('"90 km/h"]', '"90 km/h", "140 km/h"]', "light_dummy.csv", "no plateau at 140 km/h", "comes nearest"),
                (r'\[drum\]\ncircumference = "6 m"', '[drum]\ncircumference = "4 m"', "does not repeat itself"),
                ('force = "Fz"', 'force = "FZ"', 'channel "FZ" is missing', 'did you mean "Fz"'),
                ('margin = "1 km/h"', 'margin = "1 km"', "bad.toml:16", "margin")):
            bad.write_text(self.rig.read_text())
            edit(bad, (pattern, new))
            text = self.process(bad, code=WRONG_INPUT)
            for part in parts:
                self.assertIn(part, text)
        recording = (self.folder / "light_dummy.csv").read_text().splitlines(keepends=True)
        for name, lines, *parts in (
                ("cut.csv", recording[:100], "no plateau", "comes nearest"),
                ("gap.csv", recording[:500] + recording[540:], "40 samples are missing"),
                ("nan.csv", recording[:7] + ["0.0030,0.1,NaN,0\n"] + recording[8:], "nan.csv:8", "finite number"),
                ("flat.csv", [recording[0]] + [f"{i / 2000},10,4000,{i}\n" for i in range(9000)], "sensor")):
            (self.folder / name).write_text("".join(lines))
            bad.write_text(self.rig.read_text())
            edit(bad, ('"light_dummy.csv"', f'"{name}"'))
            text = self.process(bad, code=WRONG_INPUT)
            for part in (name, *parts):
                self.assertIn(part, text)


if __name__ == "__main__":
    unittest.main()
