// SPDX-License-Identifier: Apache-2.0
// Says in words how the samples of a posterior differ from the linear interval. Each word has a
// test; a word whose test fails is not said. All lengths are those of the unit cube.
//
//   as the linear interval   both ends of the 95 % interval lie within 0.25 deviations of the
//                            linear one's
//   skewed                   the upper half of the interval, from the median on, is more than 3/2
//                            or less than 2/3 of the lower one
//   banana with X            a quadratic in X explains 0.2 of the variance more than a line
//   two modes                the histogram has a valley below half of its lower peak, and more than
//                            5 % of the samples lie on each side
//   cut by its bound         more than 2.5 % of the samples lie within 1 % of the range of a bound
//   open                     the deviation exceeds 0.25 of the range
//
// Limits: a histogram of few samples has valleys by chance, so a valley counts only if both peaks
// exceed it by three deviations of the counts. Samples that the chains found are judged, no others.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "optimization/identifiability/confidence.h"

namespace latsch {

/// The shape of the samples of one variable.
struct PosteriorShape {
  double lower = 0.0, median = 0.0, upper = 0.0;  // 2.5, 50 and 97.5 % points, in the unit cube
  double mean = 0.0, deviation = 0.0;
  bool as_linear = false;
  bool skewed = false;
  std::vector<int> bananas;  // variables X whose quadratic explains this one
  bool two_modes = false;
  bool cut = false;
  bool open = false;
  /// The larger distance of the ends from those of the linear interval, in deviations.
  double distance = 0.0;
};

/// Returns the shapes of the variables, which are the rows of u, n x samples. `linear` has one
/// interval for each, in the unit cube; its ends count inside the cube.
std::vector<PosteriorShape> posterior_shapes(const Eigen::MatrixXd& u,
                                             const std::vector<Interval>& linear);

/// Returns the share of the variance of y that a quadratic in x explains beyond a line.
double bent_share(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// Returns the words of a shape, such as "skewed, banana with B"; "unlike the linear interval" if
/// the ends differ and no other test passes. `names` are those of all variables.
std::string in_words(const PosteriorShape& shape, const std::vector<std::string>& names);

}  // namespace latsch
