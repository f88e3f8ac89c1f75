// SPDX-License-Identifier: Apache-2.0
// Runs the trials of a study, each a specimen at a point driven through the required tests, and
// computes the target from the recordings.
//
// The channels of a trial are called "TEST/CHANNEL". A specimen passes on to the next what does not
// depend on the point (the symbolic work on a mesh). The outcome of a trial does not depend on
// earlier trials.
#pragma once

#include "correlation/study/study.h"
#include "evaluation/trial/evaluator.h"

namespace latsch::correlation {

/// Returns an evaluator, for the evaluation service, of the tests that fitted experiments and
/// constraints need. Values that the model does not accept give a Failure, as does a recording that
/// leaves a fitted experiment nothing to compare. Several threads may call the evaluator at once.
Evaluator evaluator(const Study& study);

/// Runs one trial with the tests of all experiments, including the predicted ones.
Result<Channels> simulate_all(const Study& study, const DesignPoint& point);

/// Returns the target over the fitted experiments, with its weighted residuals and the constraints
/// on channels. If the experiments state their noise, the target is the weighted mean over all
/// values of |d s / sigma|^k. Here s^2 is the mean of sigma^2 with weight 1 / sigma^2 for every
/// value, so the target is unchanged by the noise if all values are equally exact.
Objective objective(const Study& study);

/// Returns an upper limit (two standard deviations) of the sum of squares of those residuals that
/// the stated noise alone causes at the true values of the variables:  s^2 (1 + 2 sqrt(2 sum w^2 N)
/// / sum w N),  with N values of weight w in an experiment. Returns 0 if noise is not stated, or if
/// a robust loss changes its effect.
double noise_alone(const Study& study);

}  // namespace latsch::correlation
