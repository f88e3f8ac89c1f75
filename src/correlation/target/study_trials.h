// SPDX-License-Identifier: Apache-2.0
// Runs the trials of a study: builds a specimen at a point, runs the required tests with it, and
// computes the target from the recordings. The channels of a trial are called "TEST/CHANNEL". A
// specimen passes work that does not depend on the point to the next one (the symbolic
// factorization for a mesh). The outcome of a trial does not depend on earlier trials.
#pragma once

#include "correlation/study/study.h"
#include "evaluation/trial/evaluator.h"

namespace latsch::correlation {

/// Returns an evaluator that runs the tests that fitted experiments and constraints need. Its
/// outcome is a Failure for values that the model does not accept, and for a recording that leaves
/// a fitted experiment nothing to compare. Several threads may call it at once.
Evaluator evaluator(const Study& study);

/// Runs one trial with the tests of all experiments, including the predicted ones.
Result<Channels> simulate_all(const Study& study, const DesignPoint& point);

/// Returns the target over the fitted experiments, with its weighted residuals and the constraints
/// on channels. If the experiments state their noise, the target is the weighted mean over all
/// values of |d s / sigma|^k, where s^2 is the mean of sigma^2 with weight 1 / sigma^2 for every
/// value. If all values are equally exact, the noise therefore does not change the target.
Objective objective(const Study& study);

/// Returns an upper limit (two standard deviations) of the sum of squares that the stated noise
/// alone causes at the true values of the variables: s^2 (1 + 2 sqrt(2 sum w^2 N) / sum w N), with
/// N values of weight w in an experiment. Returns 0 if noise is not stated, or if a robust loss
/// changes its effect.
double noise_alone(const Study& study);

}  // namespace latsch::correlation
