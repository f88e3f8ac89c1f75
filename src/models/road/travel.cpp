// SPDX-License-Identifier: Apache-2.0
#include "models/road/travel.h"

#include <algorithm>
#include <cassert>

namespace latsch::road {

Travel::Travel(double speed) : Travel(std::vector<Point>{{0.0, speed}}) {}

Travel::Travel(std::vector<Point> points) : points_(std::move(points)) {
  assert(!points_.empty());
  distances_.push_back(0.0);
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Point &a = points_[i - 1], &b = points_[i];
    assert(a.time < b.time);
    distances_.push_back(distances_.back() + (b.time - a.time) * (a.speed + b.speed) / 2.0);
  }
  at_zero_ = from_first(0.0);
}

double Travel::speed(double time) const {
  if (points_.size() == 1) return points_[0].speed;
  const auto right = std::upper_bound(
      points_.begin(), points_.end(), time, [](double t, const Point& p) { return t < p.time; });
  if (right == points_.begin()) return right->speed;
  const Point& a = *(right - 1);
  if (right == points_.end()) return a.speed;
  return a.speed + (right->speed - a.speed) * (time - a.time) / (right->time - a.time);
}

double Travel::from_first(double time) const {
  if (points_.size() == 1) return (time - points_[0].time) * points_[0].speed;
  const auto right = std::upper_bound(
      points_.begin(), points_.end(), time, [](double t, const Point& p) { return t < p.time; });
  if (right == points_.begin()) return (time - right->time) * right->speed;
  const auto left = right - 1;
  return distances_[left - points_.begin()] +
         (time - left->time) * (left->speed + speed(time)) / 2.0;
}

double Travel::distance(double time) const { return from_first(time) - at_zero_; }

}  // namespace latsch::road
