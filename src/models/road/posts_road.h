// SPDX-License-Identifier: Apache-2.0
// The four plates of a post rig: level, each moved up and down by an actuator, one below each
// quarter of a car. Between samples heights go by a cubic through both ends with the slopes of
// central differences, so that velocities have no jumps; beyond them the ends are held.
#pragma once

#include <array>
#include <vector>

#include "models/road/road.h"

namespace latsch::road {

class PostsRoad final : public Road {
 public:
  struct Settings {
    double x = 0.0, y = 0.0;    // m: where the quarters meet
    std::vector<double> times;  // s, rising evenly, two at least
    /// Front left, front right, rear left, rear right, m, at these times.
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
