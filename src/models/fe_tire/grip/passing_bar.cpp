// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/passing_bar.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace latsch::fe_tire {
namespace {

constexpr int kPieces = 2000;  // pieces in the table of arcs
constexpr int kMostTurns = 60;
constexpr double kClose = 1e-14;  // m

double power(double s, int n) { return s > 0.0 ? std::pow(s, n) : 0.0; }

}  // namespace

PassingBar::PassingBar(const Size& size) : size_(size) {
  const double end = 0.5 * size.length, c = std::min({size.bevel, end, size.height});
  const double slope = c > 0.0 ? 1.0 : 0.0;
  kinks_ = {{-end, size.height - c, slope},
            {-end + c, 0.0, -slope},
            {end - c, 0.0, -slope},
            {end, c - size.height, slope}};
  // Simpson's rule sums the arcs; at() needs no table for the slope.
  const double step = 2.0 * reach() / kPieces;
  const auto stretch = [&](double s) { return std::hypot(1.0, at(s).slope) - 1.0; };
  std::vector<double> longer(kPieces + 1, 0.0);
  for (int k = 0; k < kPieces; ++k) {
    const double from = -reach() + k * step;
    longer[k + 1] =
        longer[k] +
        step / 6.0 * (stretch(from) + 4.0 * stretch(from + 0.5 * step) + stretch(from + step));
  }
  longer_ = std::move(longer);
}

double PassingBar::reach() const { return 0.5 * size_.length + size_.smooth; }

Eigen::Vector2d PassingBar::direction() const {
  return {std::cos(size_.angle), std::sin(size_.angle)};
}

PassingBar::Place PassingBar::at(double s) const {
  if (s <= -reach()) return {0.0, 0.0, longer_.empty() ? 0.0 : longer_.front()};
  if (s >= reach()) return {0.0, 0.0, longer_.empty() ? 0.0 : longer_.back()};
  // The mean with a hat is the second difference of the second integral.
  Place place{0.0, 0.0, 0.0};
  const double w = size_.smooth;
  for (const auto& [offset, weight] : {std::pair(w, 1.0), {0.0, -2.0}, {-w, 1.0}}) {
    for (const Kink& kink : kinks_) {
      const double r = s + offset - kink.s;
      place.height += weight * (kink.step * power(r, 2) / 2.0 + kink.slope * power(r, 3) / 6.0);
      place.slope += weight * (kink.step * power(r, 1) + kink.slope * power(r, 2) / 2.0);
    }
  }
  place.height /= w * w;
  place.slope /= w * w;
  if (longer_.empty()) return place;
  const double at = (s + reach()) / (2.0 * reach()) * kPieces;
  const int k = std::clamp(static_cast<int>(at), 0, kPieces - 1);
  place.longer = longer_[k] + (at - k) * (longer_[k + 1] - longer_[k]);
  return place;
}

double PassingBar::across(double arc) const {
  double s = arc;
  for (int k = 0; k < kMostTurns; ++k) {
    const double next = arc - at(s).longer;
    if (std::abs(next - s) <= kClose) return next;
    s = next;
  }
  return s;
}

FeltGround::Place GroundWithBar::at(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d across = bar_.direction();
  const PassingBar::Place bar = bar_.at(across.dot(p));
  return {bar.height, bar.slope * across, bar.longer * across};
}

Eigen::Vector2d GroundWithBar::at_arc(const Eigen::Vector2d& arc) const {
  const Eigen::Vector2d across = bar_.direction();
  const double length = across.dot(arc);
  return arc + (bar_.across(length) - length) * across;
}

}  // namespace latsch::fe_tire
