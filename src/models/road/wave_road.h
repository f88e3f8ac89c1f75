// SPDX-License-Identifier: Apache-2.0
// Waves across a level road: a sine, or a sweep of amplitude and wave length along the road.
//
// From `start` to `end`, with s = x - start over the length L = end - start,
//   z = A(s) sin φ(s),   dφ/ds = 2π / λ(s),   φ(0) = 0,
// A(s) is linear. λ(s) is linear or exponential, λ0 (λ1/λ0)^(s/L), where λ0 and λ1 are its values
// at the two ends. Elsewhere the road is level. An endless sweep keeps its initial values.
#pragma once

#include <limits>

#include "models/road/road.h"

namespace latsch::road {

class WaveRoad final : public Road {
 public:
  struct Settings {
    double start = 0.0;                                     // m
    double end = std::numeric_limits<double>::infinity();   // m
    double amplitude_begin = 0.0, amplitude_end = 0.0;      // m
    double wave_length_begin = 1.0, wave_length_end = 1.0;  // m, > 0
    bool exponential = false;
    double friction = 1.0;
  };

  explicit WaveRoad(const Settings& settings);

  GroundPoint at(double x, double y, double time) const override;
  /// Returns the mean height by the Gauss rule with three points if the line is short relative to a
  /// wave length. The error is then below 1e-9 of the height.
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override;

 private:
  Settings settings_;
  double growth_ = 0.0;  // dA/ds
  // dλ/ds for a linear sweep, or the exponent per meter for an exponential one
  double stretch_ = 0.0;
};

}  // namespace latsch::road
