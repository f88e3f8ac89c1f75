// SPDX-License-Identifier: Apache-2.0
// One trial of a study: set the variables, build the tire, run every experiment on the virtual rig,
// compare.
//
// The channels of a trial are those of all its experiments under "EXPERIMENT/CHANNEL". The
// finite-element tire and its symbolic work are kept from trial to trial as long as the mesh stays
// the same; the outcome of a trial does not depend on the trials before it.
#pragma once

#include <memory>
#include <optional>

#include "correlation/study/study.h"
#include "evaluation/trial/evaluator.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/ring/fe_tire.h"

namespace latsch::correlation {

class TireTrials {
 public:
  explicit TireTrials(const Study& study);

  /// All experiments that are fitted; with `predicted` the others too. Values the model does not
  /// accept are a Failure.
  Result<Channels> run(const DesignPoint& point, bool predicted = false);

  /// The tire at a point. Throws InputError where the model does not accept it.
  fe_tire::FeTire& tire_at(const DesignPoint& point);

 private:
  Study study_;
  std::optional<fe_tire::TireDescription> description_;  // of tire_
  std::optional<fe_tire::FeTire> tire_;
};

/// run() as the evaluation service wants it, or the rolling tire or outside program of the study.
Evaluator evaluator(const Study& study);

/// One trial with the experiments that are only predicted.
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

/// The channels of one experiment out of those of a trial, under their own names; curves take
/// theirs out of all of the trial's.
Channels channels_of(const StudyExperiment& experiment, const Channels& trial);

}  // namespace latsch::correlation
