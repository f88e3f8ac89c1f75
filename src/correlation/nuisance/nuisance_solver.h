// SPDX-License-Identifier: Apache-2.0
// Compares a trial with a recording that has nuisance numbers: they are solved at every trial, not
// searched (nuisance_projection.h).
//
// Offset and gain enter the differences linearly. A shift of the abscissa does not, so it is
// solved by Gauss-Newton steps in all numbers together: from 0 if it has a prior, and from the best
// of kFirstShifts shifts over its range if it is free. After each step offset and gain are solved
// anew, and a step that does not reduce the sum of squares is halved. The range is a tenth of the
// record in either direction; for a delay, as far as the simulation covers the measured samples.
//
// The differences of the result are those at the best numbers, and its slopes are Kaufman's. They
// give the exact slope of the sum of squares, and slopes of the single differences without the part
// that is as small as the differences themselves. A robust loss is applied afterwards.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "correlation/nuisance/nuisance_numbers.h"

namespace latsch::correlation {

/// Weights of the differences against the priors of the nuisance numbers.
struct NuisanceWeights {
  std::vector<double> deviations = {};  // one for each difference d; empty: 1 for all
  double weight = 1.0;                  // weight of the experiment
};

/// Returns the comparison at the best numbers; at the held ones if they are held. Fails as
/// Observable::compare() does.
Result<Comparison> compare_with(const Nuisance& nuisance,
                                const NuisanceWeights& weights,
                                const Observable& observable,
                                const ObjectiveSettings& settings,
                                const Channels& trial);

/// Root of the weight of each of `count` differences in the sum of squares.
Eigen::VectorXd root_weights(const NuisanceWeights& weights, std::size_t count);

/// A comparison at given values of the numbers that the recording shares with others, and at the
/// best values of its own numbers there. K: its shared numbers, in their order.
struct ComparedAtShared {
  Comparison comparison = {};
  Eigen::MatrixXd by_shared = {};  // d difference / d shared number, own ones following; m x K
  Eigen::MatrixXd numbers_by_shared = {};  // d number / d shared number, one row for each number
  double sum = 0.0;  // weighted sum of squares, with the priors of the own numbers
};

/// Compares at these values of the shared numbers, SI, of which there are K. Fails as
/// Observable::compare() does.
Result<ComparedAtShared> compare_at_shared(const Nuisance& nuisance,
                                           const NuisanceWeights& weights,
                                           const Observable& observable,
                                           const ObjectiveSettings& settings,
                                           const Channels& trial,
                                           const std::vector<double>& shared);

/// Returns the channels without their slopes, for comparisons in which a number is only tried.
Channels without_slopes(const Channels& trial);

}  // namespace latsch::correlation
