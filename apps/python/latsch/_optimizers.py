# SPDX-License-Identifier: Apache-2.0
"""Ask/tell optimizers by their names; options are the keys of [optimizer] in a study."""
import keyword

from latsch import _latsch, _toml


def _lines(options):
    """Returns the options as keys of a study. global_ is the key global, which is not a name of an argument in Python."""
    return _toml.lines({name[:-1] if name.endswith("_") and keyword.iskeyword(name[:-1]) else name: value
                        for name, value in options.items()})


def optimizer(space, method="auto", *, residuals=False, jacobian=False, constraints=False, failed_share=0.0, basins=1,
              **options):
    """Returns an optimizer over a DesignSpace. method: a name, or "auto", which chooses by the properties below.

    residuals: outcomes will be Scores with residuals (m,), whose sum of squares is the target; jacobian: with their
    derivatives (m, n), too. constraints: Scores will have nonlinear constraints. failed_share, basins: share of failed
    points and number of basins in an earlier design of experiments.

    options: keys of [optimizer] in a study (`latsch help study`): initial_step, step_tolerance, outstanding, restarts, seed,
    ...; lengths are shares of the ranges. global_="basins" with budget searches for several minima, and `minima` lists
    those found. Options of an ensemble: member={"wide": {"method": "genetic"}, "fine": {"method":
    "gss", "priority": 2}}, ends_with="all" or "first".

    Raises InputError for arguments that would be refused in a study.
    """
    return _latsch._optimizer(space, method, _lines(options), residuals, jacobian, constraints, failed_share, basins)


def cascade(space, method="gss", *, stages=2, tightening=0.25, **options):
    """Returns an optimizer that runs `stages` searches one after the other, each with bounds that are `tightening` times
    as wide around the best point of the stage before."""
    return _latsch._cascade(space, method, _lines(options), stages, tightening)


def multi_start(space, starts, method="residual_trust_region", **options):
    """Returns an optimizer that runs one search after the other, from each of `starts` (k, n); no search knows the
    results of the others."""
    return _latsch._multi_start(space, starts, method, _lines(options))
