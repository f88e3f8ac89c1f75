# SPDX-License-Identifier: Apache-2.0
"""Ask/tell optimizers by their names; options are the keys of [optimizer] in a study."""
from latsch import _latsch, _toml


def optimizer(space, method="auto", *, residuals=False, jacobian=False, constraints=False, failed_share=0.0, basins=1,
              **options):
    """An optimizer over a DesignSpace: a method by its name, or "auto" by what is known of the problem.

    residuals: outcomes will be Scores with residuals (m,), whose sum of squares is the target; jacobian: with their
    derivatives (m, n) too. constraints: Scores will bring nonlinear constraints. failed_share, basins: of a design.

    options: keys of [optimizer] in a study (`latsch help study`): initial_step, step_tolerance, outstanding, restarts, seed,
    ...; lengths are shares of the ranges. Of an ensemble: member={"wide": {"method": "genetic"}, "fine": {"method": "gss",
    "priority": 2}}, ends_with="all" or "first".

    Raises InputError for what a study would be refused for.
    """
    return _latsch._optimizer(space, method, _toml.lines(options), residuals, jacobian, constraints, failed_share, basins)


def cascade(space, method="gss", *, stages=2, tightening=0.25, **options):
    """One run after the other, each with bounds `tightening` as wide around the best point of the one before."""
    return _latsch._cascade(space, method, _toml.lines(options), stages, tightening)


def multi_start(space, starts, method="residual_trust_region", **options):
    """One run after the other, from each of `starts` (k, n); tell none of them what another has found."""
    return _latsch._multi_start(space, starts, method, _toml.lines(options))
