# SPDX-License-Identifier: Apache-2.0
"""Latsch from Python: optimizers by ask and tell, designs of experiments, identifiability; models through
virtual tests; studies and their journals.

    space = latsch.DesignSpace([latsch.Variable("k", lower=1, upper=50, initial=9)])
    optimizer = latsch.optimizer(space, residuals=True)
    while not optimizer.converged:
        point = optimizer.propose()[0]
        optimizer.observe(point, latsch.Score(residuals=measured - computed(point)))

    study = latsch.read_study("study.toml")
    study.run(workers=2)
    trials = study.trials()

    forces = latsch.test("tire.toml", {"kind": "modes", "pressure": "2.6 bar"})["frequency"]

Numbers are in SI units, axes are those of ISO 8855 (x forward, y left, z up). Arrays are NumPy arrays, copies of the data
of the libraries. Wrong data raise InputError, with file and line if there is a file. A simulation that does not succeed
gives a Failure: a function with one result raises it, and a function with several results returns it as one of them.
"""
from latsch._errors import Failure, InputError, JournalError
from latsch._latsch import (Confidence, DesignSpace, Experiment, Identification, LinearConstraint, Model, Morris, Optimizer,
                            Profile, Score, Variable, basins_of_grid, confidence, full_factorial, kernels, latin_hypercube,
                            method_names, read_model, sobol, tests)
from latsch._optimizers import cascade, multi_start, optimizer
from latsch._study import Posterior, Study, Trials, read_study
from latsch._tests import Recording, test

__version__ = "0.1.0"

__all__ = [
    "Confidence", "DesignSpace", "Experiment", "Failure", "Identification", "InputError", "JournalError", "LinearConstraint",
    "Model", "Morris", "Optimizer", "Posterior", "Profile", "Recording", "Score", "Study", "Trials", "Variable", "basins_of_grid",
    "cascade", "confidence", "full_factorial", "kernels", "latin_hypercube", "method_names", "multi_start", "optimizer",
    "read_model", "read_study", "sobol", "test", "tests"]
