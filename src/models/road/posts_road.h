// SPDX-License-Identifier: Apache-2.0
// The road of a four-post rig: four level plates, one below each quarter of a car, each moved up
// and down by an actuator. Between samples the height is a cubic polynomial in time, with slopes
// from central differences, so that velocities are continuous. Beyond the samples the first and
// last heights are kept.
#pragma once

#include <array>
#include <vector>

#include "models/road/road.h"

namespace latsch::road {

class PostsRoad final : public Road {
 public:
  struct Settings {
    double x = 0.0, y = 0.0;    // m, point at which the four plates meet
    std::vector<double> times;  // s, sample times, evenly spaced, at least two
    /// Heights of the plates at these times: front left, front right, rear left, rear right, m.
    std::array<std::vector<double>, 4> heights;
  };

  explicit PostsRoad(Settings settings);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override;

 private:
  struct Moved {
    double height, velocity;
  };
  int post(double x, double y) const {
    return (x >= settings_.x ? 0 : 2) + (y >= settings_.y ? 0 : 1);
  }
  Moved moved(int post, double time) const;

  Settings settings_;
  double step_;
};

}  // namespace latsch::road
