// SPDX-License-Identifier: Apache-2.0
// The trials of a study: the specimen at a point, driven through the tests that are asked for; and
// the target that is made of what they record.
//
// The channels of a trial are called "TEST/CHANNEL". A specimen hands on to the next what does not
// depend on the point (the symbolic work on a mesh); the outcome of a trial does not depend on the
// trials before it.
#pragma once

#include "correlation/study/study.h"
#include "evaluation/trial/evaluator.h"

namespace latsch::correlation {

/// The tests that fitted experiments and constraints ask for, as the evaluation service wants them.
/// Values the model does not accept are a Failure; so is a recording that leaves a fitted
/// experiment nothing to compare. May be called by several threads at once.
Evaluator evaluator(const Study& study);

/// One trial with all tests of all experiments, those that are only predicted too.
Result<Channels> simulate_all(const Study& study, const DesignPoint& point);

/// The target over the fitted experiments, with its weighted residuals and the constraints on
/// channels. Where the experiments state their noise it is the weighted mean over all values of
/// |d s / sigma|^k, with s^2 the mean of sigma^2 in which every value has the weight 1 / sigma^2:
/// the same as without noise where all values are equally exact.
Objective objective(const Study& study);

/// What the stated noise alone makes of the squares of those residuals, at the true values of the
/// variables and with two standard deviations:  s^2 (1 + 2 sqrt(2 sum w^2 N) / sum w N),  N values
/// of weight w an experiment. 0 where noise is not stated, or a robust loss changes what it makes.
double noise_alone(const Study& study);

}  // namespace latsch::correlation
