// SPDX-License-Identifier: Apache-2.0
#include "models/road/profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::road {

Profile::Profile(std::vector<Point> points) : points_(std::move(points)) {
  assert(std::is_sorted(
      points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.s < b.s; }));
  for (const Point& point : points_) reach_ = std::max(reach_, std::abs(point.z));
}

Profile::Value Profile::at(double s) const {
  if (points_.empty()) return {};
  const auto right = std::lower_bound(
      points_.begin(), points_.end(), s, [](const Point& p, double at) { return p.s < at; });
  if (right == points_.end()) return {points_.back().z, 0.0};
  if (right->s > s) {
    if (right == points_.begin()) return {right->z, 0.0};
    const auto left = right - 1;
    const double slope = (right->z - left->z) / (right->s - left->s);
    return {left->z + slope * (s - left->s), slope};
  }
  Value value{right->z, 0.0};
  auto last = right;
  for (auto p = right; p != points_.end() && p->s == s; last = p++) {
    value.height = std::max(value.height, p->z);
  }
  if (const auto next = last + 1; next != points_.end()) {
    value.slope = (next->z - last->z) / (next->s - last->s);
  }
  return value;
}

Profile cleat_profile(double height, double length, double bevel) {
  assert(length > 0.0 && bevel >= 0.0 && bevel <= std::abs(height) && bevel <= length / 2.0);
  const double half = length / 2.0;
  const double rim = height > 0.0 ? height - bevel : -bevel;
  if (bevel == 0.0) return Profile({{-half, 0.0}, {-half, height}, {half, height}, {half, 0.0}});
  if (height > 0.0) {
    return Profile({{-half, 0.0},
                    {-half, rim},
                    {-half + bevel, height},
                    {half - bevel, height},
                    {half, rim},
                    {half, 0.0}});
  }
  return Profile({{-half, 0.0},
                  {-half + bevel, rim},
                  {-half + bevel, height},
                  {half - bevel, height},
                  {half - bevel, rim},
                  {half, 0.0}});
}

Profile half_round_profile(double radius, int pieces) {
  assert(radius > 0.0 && pieces >= 2);
  std::vector<Profile::Point> points;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = std::numbers::pi * i / pieces;
    const bool end = i == 0 || i == pieces;
    points.push_back({-radius * std::cos(angle), end ? 0.0 : radius * std::sin(angle)});
  }
  return Profile(std::move(points));
}

}  // namespace latsch::road
