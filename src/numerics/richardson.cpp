// SPDX-License-Identifier: Apache-2.0
#include "numerics/richardson.h"

#include <cmath>

namespace latsch::numerics {
namespace {

/// Returns the ratio (v(h0) - v(h1)) / (v(h1) - v(h2)) that values with an error C h^p have. The
/// ratio grows with p.
double ratio_of(const std::array<double, 3>& h, double p) {
  return (std::pow(h[0], p) - std::pow(h[1], p)) / (std::pow(h[1], p) - std::pow(h[2], p));
}

double value_at_zero(const std::array<double, 3>& h, const std::array<double, 3>& v, double p) {
  const double C = (v[1] - v[2]) / (std::pow(h[1], p) - std::pow(h[2], p));
  return v[2] - C * std::pow(h[2], p);
}

}  // namespace

Extrapolation extrapolate(const std::array<double, 3>& h,
                          const std::array<double, 3>& v,
                          double assumed_order) {
  double low = 1.0, high = 2.0 * assumed_order;
  const double coarse = v[0] - v[1], fine = v[1] - v[2];
  const double seen = fine != 0.0 ? coarse / fine : 0.0;
  if (!(seen >= ratio_of(h, low) && seen <= ratio_of(h, high))) {
    return {value_at_zero(h, v, assumed_order), assumed_order, false};
  }
  for (int i = 0; i < 60; ++i) {
    const double p = 0.5 * (low + high);
    (ratio_of(h, p) < seen ? low : high) = p;
  }
  const double p = 0.5 * (low + high);
  return {value_at_zero(h, v, p), p, true};
}

}  // namespace latsch::numerics
