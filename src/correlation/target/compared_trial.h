// SPDX-License-Identifier: Apache-2.0
// Measures of the comparisons that compare_all() makes of one trial, and residuals of the priors of
// nuisance numbers and variables.
#pragma once

#include <vector>

#include "correlation/study/study.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

/// Returns the error of a comparison without weights in the measure of its experiment, which is the
/// mean of |d|^k to the power 1/k, with the relative differences d; 1 = 100 %. Terminal, page,
/// report and JSON all show this number for an experiment.
double own_measure(const StudyExperiment& experiment, const Comparison& comparison);

/// Returns the name of the experiment's measure: "mean", "RMS", "mean to the power 4".
std::string measure_in_words(const StudyExperiment& experiment);

/// Residual of the prior of one nuisance number.
struct NuisancePrior {
  double residual = 0.0;            // the number over its stated deviation
  std::vector<double> slopes = {};  // d residual / d variable; empty: not known
};

/// Returns one residual for each nuisance number with a prior that is counted with experiment `e`,
/// in their order.
std::vector<NuisancePrior> nuisance_priors(const std::vector<StudyExperiment>& experiments,
                                           std::size_t e,
                                           const Comparison& comparison);

/// Residual of the prior of one variable at a point.
struct PriorResidual {
  int variable = 0;       // index in the space
  double residual = 0.0;  // deviation from the expected value over the stated deviation
  double slope = 0.0;     // d residual / d variable
};

/// Returns one residual for each variable with a prior, in the order of the variables.
std::vector<PriorResidual> prior_residuals(const DesignSpace& space, const DesignPoint& point);

}  // namespace latsch::correlation
