// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/force_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace latsch::multibody {

std::string ForceCharacteristic::fault(const std::vector<Point>& points) {
  if (points.size() < 2)
    return fmt::format("has {} points, two at least are needed", points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].first) || !std::isfinite(points[i].second))
      return fmt::format("has a point, number {}, that is not a number", i + 1);
    if (i > 0 && !(points[i].first > points[i - 1].first))
      return fmt::format("does not rise in x: point {} has {:.6g} behind {:.6g}",
                         i + 1,
                         points[i].first,
                         points[i - 1].first);
  }
  return {};
}

ForceCharacteristic::ForceCharacteristic(std::vector<Point> points) : points_(std::move(points)) {
  assert(fault(points_).empty());
  const std::size_t last = points_.size() - 1;
  const auto width = [&](std::size_t i) { return points_[i + 1].first - points_[i].first; };
  const auto chord = [&](std::size_t i) {
    return (points_[i + 1].second - points_[i].second) / width(i);
  };
  slopes_.resize(points_.size());
  slopes_[0] = chord(0);
  slopes_[last] = chord(last - 1);
  for (std::size_t i = 1; i < last; ++i) {
    const double before = chord(i - 1), behind = chord(i);
    const double w1 = 2.0 * width(i) + width(i - 1), w2 = width(i) + 2.0 * width(i - 1);
    slopes_[i] = before * behind > 0.0 ? (w1 + w2) / (w1 / before + w2 / behind) : 0.0;
  }
  areas_.assign(points_.size(), 0.0);
  for (std::size_t i = 1; i <= last; ++i) areas_[i] = area_from_first(points_[i].first);
}

std::size_t ForceCharacteristic::interval(double x) const {
  const auto behind =
      std::upper_bound(points_.begin() + 1, points_.end() - 1, x, [](double v, const Point& p) {
        return v < p.first;
      });
  return static_cast<std::size_t>(behind - points_.begin()) - 1;
}

double ForceCharacteristic::at(double x) const {
  const Point &first = points_.front(), &last = points_.back();
  if (x <= first.first) return first.second + slopes_.front() * (x - first.first);
  if (x >= last.first) return last.second + slopes_.back() * (x - last.first);
  const std::size_t i = interval(x);
  const double w = points_[i + 1].first - points_[i].first, s = (x - points_[i].first) / w,
               r = 1.0 - s;
  return r * r * ((1.0 + 2.0 * s) * points_[i].second + s * w * slopes_[i]) +
         s * s * ((1.0 + 2.0 * r) * points_[i + 1].second - r * w * slopes_[i + 1]);
}

double ForceCharacteristic::slope(double x) const {
  if (x <= points_.front().first) return slopes_.front();
  if (x >= points_.back().first) return slopes_.back();
  const std::size_t i = interval(x);
  const double w = points_[i + 1].first - points_[i].first, s = (x - points_[i].first) / w,
               r = 1.0 - s;
  return 6.0 * s * r * (points_[i + 1].second - points_[i].second) / w +
         r * (r - 2.0 * s) * slopes_[i] + s * (s - 2.0 * r) * slopes_[i + 1];
}

double ForceCharacteristic::area_from_first(double x) const {
  const Point &first = points_.front(), &last = points_.back();
  if (x <= first.first) {
    const double d = x - first.first;
    return d * (first.second + 0.5 * slopes_.front() * d);
  }
  if (x > last.first) {
    const double d = x - last.first;
    return areas_.back() + d * (last.second + 0.5 * slopes_.back() * d);
  }
  const std::size_t i = interval(x);
  const double x0 = points_[i].first;  // Simpson's rule is exact for a cubic
  return areas_[i] + (x - x0) / 6.0 * (points_[i].second + 4.0 * at(0.5 * (x0 + x)) + at(x));
}

double ForceCharacteristic::area(double x) const {
  return area_from_first(x) - area_from_first(0.0);
}

}  // namespace latsch::multibody
