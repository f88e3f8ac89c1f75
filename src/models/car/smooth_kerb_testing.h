// SPDX-License-Identifier: Apache-2.0
// A smooth kerb below the left wheels: four waves of height (sin π s/L)^4 with pitch L = 0.8 m,
// from x = 3 m. Because it is smooth, the order of convergence of the time steps can be measured on
// it, provided that no tire lifts off.
#pragma once

#include <cmath>
#include <numbers>

#include "models/road/road.h"

namespace latsch::car {

class SmoothKerb final : public road::Road {
 public:
  explicit SmoothKerb(double height = 0.01) : height_(height) {}

  road::GroundPoint at(double x, double y, double) const override {
    constexpr double kPitch = 0.8;  // m
    road::GroundPoint ground;
    const double s = (x - 3.0) / kPitch;
    if (y < 0.0 || s < 0.0 || s > 4.0) return ground;
    const double sine = std::sin(std::numbers::pi * s), cosine = std::cos(std::numbers::pi * s);
    ground.height = height_ * std::pow(sine, 4);
    const double slope = height_ * 4.0 * std::pow(sine, 3) * cosine * std::numbers::pi / kPitch;
    ground.normal = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
    return ground;
  }

 private:
  double height_;  // m
};

}  // namespace latsch::car
