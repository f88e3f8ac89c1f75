// SPDX-License-Identifier: Apache-2.0
#include "models/tire/footprint.h"

#include <algorithm>
#include <cmath>

namespace latsch {
namespace {

/// Of two intervals around their middles.
double overlap(double a, double a_length, double b, double b_length) {
  return std::max(0.0,
                  std::min(a + 0.5 * a_length, b + 0.5 * b_length) -
                      std::max(a - 0.5 * a_length, b - 0.5 * b_length));
}

}  // namespace

double Footprint::pressure_at(double x, double y, double side) const {
  double force = 0.0;
  for (const FootprintElement& at : elements)
    force += at.pressure * overlap(x, side, at.x, at.length) * overlap(y, side, at.y, at.width);
  return force / (side * side);
}

/// The mean is a sum of trapezoids in x and in y, which is largest where one of them stops rising:
/// an edge of the sensor lies on one of an element then.
double Footprint::peak_pressure(double side) const {
  std::vector<double> ys;
  for (const FootprintElement& at : elements)
    for (const double edge : {-0.5, 0.5}) ys.push_back(at.y + edge * (at.width - side));
  std::sort(ys.begin(), ys.end());
  ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
  double peak = 0.0;
  for (const double y : ys) {
    struct Rise {
      double x, slope;  // m, N/m^3 that the mean's slope changes by
    };
    std::vector<Rise> rises;
    for (const FootprintElement& at : elements) {
      const double force = at.pressure * overlap(y, side, at.y, at.width);
      if (!(force > 0.0)) continue;
      const double most = 0.5 * (at.length + side), top = 0.5 * std::abs(at.length - side);
      rises.insert(
          rises.end(),
          {{at.x - most, force}, {at.x - top, -force}, {at.x + top, -force}, {at.x + most, force}});
    }
    std::sort(rises.begin(), rises.end(), [](const Rise& a, const Rise& b) { return a.x < b.x; });
    double sum = 0.0, slope = 0.0, before = 0.0;
    for (const Rise& rise : rises) {
      sum += slope * (rise.x - before);
      slope += rise.slope;
      before = rise.x;
      peak = std::max(peak, sum / (side * side));
    }
  }
  return peak;
}

double Footprint::grip_level() const {
  double used = 0.0, all = 0.0;
  for (const FootprintElement& at : elements) {
    const double limit = at.friction * at.pressure;
    used += std::min(limit, std::hypot(at.shear_x, at.shear_y)) * at.area();
    all += limit * at.area();
  }
  return all > 0.0 ? used / all : 0.0;
}

}  // namespace latsch
