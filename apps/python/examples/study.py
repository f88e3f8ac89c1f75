#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a study, runs it with the program, and reads its journal as arrays; then repeats the fit with a loop in
Python.

   python3 study.py FOLDER      (copies studies/compliance to FOLDER)"""
import pathlib
import shutil
import sys

import latsch
import numpy as np

folder = pathlib.Path(sys.argv[1]) / "compliance"
shutil.copytree(pathlib.Path(__file__).resolve().parents[3] / "studies/compliance", folder, dirs_exist_ok=True)
study = latsch.read_study(folder / "study.toml")
print(f"{study.title}: {len(study.variables)} variables, {len(study.experiments)} experiments, by {study.method}")

result = study.run(workers=1, progress=False)  # run() also continues an interrupted run
print(f"{result['trials']} trials, target {result['target']:.2e}")

trials = study.trials(channels=["B/toe_by_Fy"])
good = ~np.isnan(trials.targets)
print(f"B/toe_by_Fy of {good.sum()} trials, {trials.channels['B/toe_by_Fy'].shape}, "
      f"from {trials.channels['B/toe_by_Fy'][good].min():.2e} to {trials.channels['B/toe_by_Fy'][good].max():.2e} "
      f"{trials.units['B/toe_by_Fy']}")

# This search takes the same path as the program, but evaluates the trials in this process: study.score() returns
# residuals and their derivatives.
optimizer = latsch.optimizer(study.space, "levenberg_marquardt")
least = np.inf
while not optimizer.converged:
    point = optimizer.propose()[0]
    try:
        score = study.score(point)
    except latsch.Failure as failure:
        optimizer.observe(point, failure)
        continue
    optimizer.observe(point, score)
    least = min(least, score.value)
print(f"by the loop here: target {least:.2e}")
