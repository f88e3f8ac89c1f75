// SPDX-License-Identifier: Apache-2.0
// The outline of a cam, |x/a|^c + |z/b|^c = 1, as its depth below the middle.
#pragma once

#include <algorithm>
#include <cmath>

namespace latsch::rigid_ring {

struct CamOutline {
  double a = 0.3, b = 0.3;  // m, half axes
  double c = 1.8;           // order, >= 1

  /// Returns the depth below the middle, m, 0 <= depth <= b; 0 beyond |x| = a.
  double depth(double x) const {
    const double xi = std::abs(x) / a;
    return xi < 1.0 ? b * std::pow(1.0 - std::pow(xi, c), 1.0 / c) : 0.0;
  }
  /// Returns d depth/dx, |x| < a.
  double slope(double x) const {
    const double xi = std::abs(x) / a;
    const double rest = std::max(1.0 - std::pow(xi, c), 1e-300);
    return std::copysign(b / a * std::pow(xi, c - 1.0) * std::pow(rest, 1.0 / c - 1.0), -x);
  }
  /// Returns the x at which the outline touches a straight line that rises by `rise`: slope(x) =
  /// -rise.
  double touch(double rise) const {
    // With t = xi^c/(1 - xi^c) the condition slope(x) = -rise is rise a/b = t^((c-1)/c).
    const double t = std::pow(std::abs(rise) * a / b, c / (c - 1.0));
    return std::copysign(std::isinf(t) ? a : a * std::pow(t / (1.0 + t), 1.0 / c), rise);
  }
};

}  // namespace latsch::rigid_ring
