// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/rolling_friction.h"

#include <algorithm>
#include <cmath>

namespace latsch::fe_tire {
namespace {

constexpr int kBisections = 60;  // halvings of an interval, to rounding

/// Returns s and its slope, without the straight line.
struct Peak {
  double s, slope;
};

Peak peak_at(const RollingFriction& law, double w) {
  if (!law.depends_on_speed() || !(w > 0.0)) return {1.0, 0.0};
  const double log = std::log(w / law.peak_speed) / law.width;
  const double part = (law.peak - 1.0) * std::exp(-log * log);
  return {1.0 + part, -2.0 * part * log / (law.width * w)};
}

/// Speed at which s falls most steeply: with y = log(w/w_m)/c, s' is -y exp(-y^2 - c y) times a
/// constant, whose extremes are at 2 y^2 + c y = 1.
double speed_of_steepest(const RollingFriction& law) {
  const double c = law.width, y = 0.25 * (std::sqrt(c * c + 8.0) - c);
  return law.peak_speed * std::exp(c * y);
}

/// Returns the border between places where `is_before` is true and those beyond, where it is not.
template <class Before>
double border(double from, double to, const Before& is_before) {
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (from + to);
    (is_before(middle) ? from : to) = middle;
  }
  return from;
}

}  // namespace

double RollingFriction::by_speed(double w) const {
  if (w > line_from && w < line_to)
    return peak_at(*this, line_from).s - line_fall * (w - line_from);
  return peak_at(*this, w).s;
}

double RollingFriction::at(double p, double w) const {
  double mu = at_rest;
  if (a != 0.0 && p > 0.0) mu *= std::pow(p / p_0, -a);
  return depends_on_speed() ? mu * by_speed(w) : mu;
}

double RollingFriction::limit_slope(double p, double w) const { return (1.0 - a) * at(p, w); }

double RollingFriction::speed_slope(double p, double w) const {
  if (!depends_on_speed()) return 0.0;
  const double slope = w > line_from && w < line_to ? -line_fall : peak_at(*this, w).slope;
  return at(p, 0.0) * slope;
}

double RollingFriction::steepest_fall() const {
  return depends_on_speed() ? -peak_at(*this, speed_of_steepest(*this)).slope : 0.0;
}

RollingFriction RollingFriction::no_steeper_than(double fall) const {
  RollingFriction law = *this;
  law.line_from = law.line_to = law.line_fall = 0.0;
  if (law.steepest_fall() <= fall) return law;
  const double steepest = speed_of_steepest(law);
  const double from =
      border(law.peak_speed, steepest, [&](double w) { return -peak_at(law, w).slope < fall; });
  const double top = peak_at(law, from).s;
  // The line comes down to s = 1, below which s does not fall, at the end of the interval.
  law.line_to = border(steepest, from + (top - 1.0) / fall, [&](double w) {
    return top - fall * (w - from) > peak_at(law, w).s;
  });
  law.line_from = from;
  law.line_fall = fall;
  return law;
}

double RollingFriction::most_above() const {
  if (!(line_to > line_from)) return 0.0;
  // The line is farthest above where s has its slope again, beyond the steepest place.
  const double w = border(std::min(speed_of_steepest(*this), line_to), line_to, [&](double at) {
    return -peak_at(*this, at).slope > line_fall;
  });
  return by_speed(w) - peak_at(*this, w).s;
}

}  // namespace latsch::fe_tire
