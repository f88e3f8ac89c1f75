#!/usr/bin/env python3
"""Tests the program under mpirun.

   ranks_test.py PATH/TO/latsch"""
import contextlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

from cli_testing import DONE, LATSCH, WRONG_INPUT, Outside, edit, trials_of


@unittest.skipUnless(shutil.which("mpirun"), "Open MPI (mpirun) is not installed")
class Ranks(Outside):
    """Tests killed ranks under mpirun; ./bench.sh mpi_faults is the long form."""

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

    def test_ranks_of_different_studies_are_refused(self):
        other = self.folder / "other"
        shutil.copytree(self.quarter_car.parent, other)
        edit(other / "study.toml", ('"quarter_car.py", "car.txt"', '"quarter_car.py", "./car.txt"'))
        run = subprocess.run([*self.job("run", self.quarter_car), ":", "-n", "1", LATSCH, "run", other / "study.toml"],
                             capture_output=True, text=True, timeout=60)
        self.assert_says(run.stderr, "were given different studies", "sbatch --array")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertFalse(self.journal.exists() or (other / "study.latsch").exists())

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
            self.wait_for_the_last_rank()
            kept = trials_of(self.journal)
            self.assertGreaterEqual(kept, 4)
            resumed = self.mpi("resume", self.quarter_car)
            self.assert_says(resumed, f"{kept} finished trials are reused")
            self.assertEqual(self.RESULT.search(resumed)[0], alone)

    def test_stages_are_served_one_after_the_other(self):
        edit(self.quarter_car, (r"\[optimizer\]", '[stage.wide]\nstep_tolerance = 0.05\n[stage.narrow]\nbounds = 0.3\n[optimizer]'))
        # The number of trials that the second stage reuses depends on how many workers evaluated points ahead in the
        # first stage, so it is not compared.
        result = lambda text: re.sub(r"\d+ finished trials are reused\n", "", self.RESULT.search(text)[0])
        alone = result(self.latsch("run", self.quarter_car))
        self.journal.unlink()
        self.assertEqual(result(self.mpi("run", self.quarter_car)), alone)
        self.assert_says(self.mpi("doe", self.quarter_car, "--levels", "2"), "of 4 points")

    def ranks(self):
        """Returns the processes of `latsch run` in the MPI job, by rank."""
        found = {}
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            with contextlib.suppress(OSError):
                words = (process / "cmdline").read_bytes().split(b"\0")
                if words[0] == b"mpirun" or not {b"run", bytes(self.quarter_car)} <= set(words):
                    continue
                for setting in (process / "environ").read_bytes().split(b"\0"):
                    if setting.startswith(b"OMPI_COMM_WORLD_RANK="):
                        found[int(setting.split(b"=")[1])] = int(process.name)
        return found

    def kill(self, rank):
        self.assertIn(rank, self.ranks())
        os.kill(self.ranks()[rank], signal.SIGKILL)

    def wait_for_the_last_rank(self):
        """Waits until all ranks have ended: mpirun may end before them, and the master writes to the journal until
        its own end."""
        end = time.monotonic() + 30
        while self.ranks():
            self.assertLess(time.monotonic(), end, "a rank goes on without its job")
            time.sleep(0.01)


class Tasks(Outside):
    """Tests several tasks that no MPI joins to one job, as with srun --mpi=none; ./bench.sh slurm uses a real Slurm.
    """

    def test_one_says_what_works_and_none_touches_the_journal(self):
        study = self.study("quarter_car")
        slurm = {"SLURM_STEP_NUM_TASKS": "3", "SLURM_NTASKS": "3"}
        for verb in (("run", study), ("doe", study, "--levels", "2")):
            said = [self.latsch(*verb, code=WRONG_INPUT if task == 0 else DONE,
                                env={**os.environ, **slurm, "SLURM_PROCID": str(task)}) for task in range(3)]
            self.assert_says(said[0], "3 tasks were started by srun", "srun --mpi=pmix latsch run", "sbatch --array")
            self.assertEqual(said[1:], ["", ""])
            self.assertFalse((study.parent / "study.latsch").exists())

    def test_a_batch_script_is_one_process(self):
        study = self.study("quarter_car")
        edit(study, ("step_tolerance = .*", "max_steps = 2"), (r"\[run\]", "[run]\nintervals = false"))
        self.assert_says(self.latsch("run", study, env={**os.environ, "SLURM_NTASKS": "3", "SLURM_PROCID": "0"}),
                         "Best of 2 steps")


if __name__ == "__main__":
    unittest.main()
