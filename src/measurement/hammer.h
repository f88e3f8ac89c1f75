// SPDX-License-Identifier: Apache-2.0
// The frequency response of a rig from hammer hits: each hit has a window of its own, and spectra
// are averaged over the hits.
//
//   H1 = sum conj(X) Y / sum |X|^2       least sensitive to noise at the output
//   H2 = sum |Y|^2 / sum conj(Y) X       least sensitive to noise at the input
//   gamma^2 = |sum conj(X) Y|^2 / (sum |X|^2 sum |Y|^2)
#pragma once

#include <span>
#include <vector>

#include "measurement/rig_response_fit.h"

namespace latsch {

struct HammerSettings {
  double threshold = 0.2;  // share of the largest hit
  double before = 0.02;    // s; part of the window before the hit
  double window = 1.0;     // s; long enough for the rig to come to rest
};

/// Returns the first sample of the window of each hit. A window with a second hit in it is left
/// out. Throws InputError if there is no hit or if every window has a second hit or is cut off.
std::vector<int> find_hits(std::span<const double> hammer,
                           double rate,
                           const HammerSettings& settings);

enum class Estimator { h1, h2 };

/// Returns the frequency response averaged over the chosen hits; a hit may be chosen several times.
MeasuredResponse hammer_response(std::span<const double> hammer,
                                 std::span<const double> force,
                                 double rate,
                                 const std::vector<int>& hits,
                                 const HammerSettings& settings,
                                 Estimator estimator = Estimator::h1);

}  // namespace latsch
