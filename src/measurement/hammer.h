// SPDX-License-Identifier: Apache-2.0
// The frequency response of a rig from hammer hits: each hit one window, averaged over the hits.
//
//   H1 = sum conj(X) Y / sum |X|^2       noise at the output counts least
//   H2 = sum |Y|^2 / sum conj(Y) X       noise at the input
//   gamma^2 = |sum conj(X) Y|^2 / (sum |X|^2 sum |Y|^2)
#pragma once

#include <span>
#include <vector>

#include "measurement/rig_response_fit.h"

namespace latsch {

struct HammerSettings {
  double threshold = 0.2;  // of the hardest hit
  double before = 0.02;    // s in front of a hit that belong to its window
  double window = 1.0;     // s: the rig has come to rest by then
};

/// The windows of the hits: their first samples. A second hit within a window spoils it and leaves
/// it out. Throws InputError where there is no hit or every one is spoilt or cut off.
std::vector<int> find_hits(std::span<const double> hammer,
                           double rate,
                           const HammerSettings& settings);

enum class Estimator { h1, h2 };

/// Over the hits chosen; any may come more than once.
MeasuredResponse hammer_response(std::span<const double> hammer,
                                 std::span<const double> force,
                                 double rate,
                                 const std::vector<int>& hits,
                                 const HammerSettings& settings,
                                 Estimator estimator = Estimator::h1);

}  // namespace latsch
