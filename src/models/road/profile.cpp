// SPDX-License-Identifier: Apache-2.0
#include "models/road/profile.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace latsch::road {
namespace {

// Points whose distance along s is smaller form a vertical flank, because their slope would be
// meaningless.
constexpr double kFlank = 1e-9;  // m

// Up to this number of points a binary search is faster than a look-up table.
constexpr std::size_t kFew = 16;

}  // namespace

Profile::Profile(std::vector<Point> points) : points_(std::move(points)) {
  assert(std::is_sorted(
      points_.begin(), points_.end(), [](const Point& a, const Point& b) { return a.s < b.s; }));
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (points_[i].s - points_[i - 1].s < kFlank) points_[i].s = points_[i - 1].s;
  }
  for (const Point& point : points_) reach_ = std::max(reach_, std::abs(point.z));
  areas_.assign(points_.size(), 0.0);
  slopes_.assign(points_.size(), 0.0);
  for (std::size_t i = 0; i + 1 < points_.size(); ++i)
    if (const double run = points_[i + 1].s - points_[i].s; run > 0.0)
      slopes_[i] = (points_[i + 1].z - points_[i].z) / run;
  for (std::size_t i = 1; i < points_.size(); ++i)
    areas_[i] =
        areas_[i - 1] + 0.5 * (points_[i].z + points_[i - 1].z) * (points_[i].s - points_[i - 1].s);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double z = points_[i].z;
    if (i % kFew == 0) of_several_.push_back({z, z});
    of_several_.back().lowest = std::min(of_several_.back().lowest, z);
    of_several_.back().highest = std::max(of_several_.back().highest, z);
  }
  if (points_.size() <= kFew || !(end() > begin())) return;
  // One part of the look-up table per interval between points.
  const auto parts = points_.size() - 1;
  parts_per_meter_ = static_cast<double>(parts) / (end() - begin());
  even_ = true;
  for (std::size_t i = 0; i < parts; ++i) {
    const double s = begin() + static_cast<double>(i) / parts_per_meter_;
    even_ = even_ && std::abs(points_[i].s - s) * parts_per_meter_ < 0.25;
    const auto first = std::lower_bound(
        points_.begin(), points_.end(), s, [](const Point& p, double at) { return p.s < at; });
    first_in_.push_back(static_cast<int>(first - points_.begin()));
  }
}

/// Returns the first point in the range `from` to `to` whose s is not smaller than the given one,
/// or `to` if there is none.
Profile::Place Profile::search(double s, Place from, Place to) const {
  return std::lower_bound(from, to, s, [](const Point& p, double at) { return p.s < at; });
}

std::span<const Profile::Point> Profile::points_between(double s0, double s1) const {
  const auto first = first_from(s0);
  auto last = std::max(first, first_from(s1));
  while (last != points_.end() && last->s <= s1) ++last;
  return {first, last};
}

Profile::Value Profile::at(double s) const { return at(s, first_from(s)); }

double Profile::area(double s) const { return area(s, first_from(s)); }

Profile::Extremes Profile::between(double s0, double s1) const {
  const double z0 = at(s0).height, z1 = at(s1).height;
  Extremes extremes{std::min(z0, z1), std::max(z0, z1)};
  const auto add = [&](double lowest, double highest) {
    extremes.lowest = std::min(extremes.lowest, lowest);
    extremes.highest = std::max(extremes.highest, highest);
  };
  const auto points = points_between(s0, s1);
  auto i = static_cast<std::size_t>(points.data() - points_.data());
  const std::size_t end = i + points.size();
  while (i < end) {
    if (i % kFew == 0 && i + kFew <= end) {
      add(of_several_[i / kFew].lowest, of_several_[i / kFew].highest);
      i += kFew;
    } else {
      add(points_[i].z, points_[i].z);
      ++i;
    }
  }
  return extremes;
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

Profile rounded_profile(const std::vector<Profile::Point>& points,
                        const std::vector<double>& radii) {
  assert(points.size() == radii.size());
  constexpr double kChord = std::numbers::pi / 36.0;
  // Largest turn of the profile at a corner, rad. Beyond it the two edges nearly coincide, and no
  // arc fits between them.
  constexpr double kSharpest = 0.999 * std::numbers::pi;
  std::vector<Profile::Point> rounded;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d p(points[i].s, points[i].z);
    const bool end = i == 0 || i + 1 == points.size();
    if (end || radii[i] <= 0.0) {
      rounded.push_back(points[i]);
      continue;
    }
    const Eigen::Vector2d before = Eigen::Vector2d(points[i - 1].s, points[i - 1].z) - p;
    const Eigen::Vector2d behind = Eigen::Vector2d(points[i + 1].s, points[i + 1].z) - p;
    const double half = std::min(before.norm(), behind.norm()) / 2.0;
    const double turn =
        std::numbers::pi -
        std::acos(std::clamp(before.normalized().dot(behind.normalized()), -1.0, 1.0));
    if (half == 0.0 || turn == 0.0 || turn > kSharpest) {
      rounded.push_back(points[i]);
      continue;
    }
    // The arc touches both edges at the distance `leg` from the corner. Its points are linear
    // combinations of the vectors to the two points of contact.
    const double leg = std::min(radii[i] * std::tan(turn / 2.0), half);
    const Eigen::Vector2d from = p + leg * before.normalized(), to = p + leg * behind.normalized();
    const int pieces = static_cast<int>(std::ceil(turn / kChord));
    for (int k = 0; k <= pieces; ++k) {
      const double angle = turn * k / pieces;
      const double a = std::sin(turn - angle) / std::sin(turn),
                   b = std::sin(angle) / std::sin(turn);
      const Eigen::Vector2d center =
          p +
          (from + to - 2.0 * p) / (2.0 * std::pow(std::cos((std::numbers::pi - turn) / 2.0), 2));
      const Eigen::Vector2d point = center + a * (from - center) + b * (to - center);
      rounded.push_back({std::max(point.x(), rounded.back().s), point.y()});
    }
  }
  return Profile(std::move(rounded));
}

}  // namespace latsch::road
