// SPDX-License-Identifier: Apache-2.0
// The section of an obstacle: height over a coordinate s, linear between its points.
//
//   cleat:      ____________  height        kerb, saw tooth:      /|   /|   /|
//          bevel/            \                                   / |  / |  / |
//              |              |                                 /  | /  | /  |
//       -------+              +-------  0                      /   |/   |/   |
//
// Two points with the same s form a vertical flank; exactly at this s the height is the greater of
// both. Beyond its ends a profile keeps the height of its end point.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace latsch::road {

class Profile {
 public:
  struct Point {
    double s = 0.0;  // m
    double z = 0.0;  // m
  };
  struct Value {
    double height = 0.0;  // m
    double slope = 0.0;   // dz/ds; at a corner the slope of the edge after it
  };

  /// Makes a level profile at the height zero.
  Profile() = default;
  /// Makes a profile from points in order of s, which must not decrease.
  explicit Profile(std::vector<Point> points);

  Value at(double s) const;
  /// Returns the integral of the height from the start of the profile to s, m^2. The profile must
  /// not be empty.
  double area(double s) const;
  struct Extremes {
    double lowest, highest;  // m
  };
  /// Returns the lowest and highest z for s0 <= s <= s1.
  Extremes between(double s0, double s1) const;
  const std::vector<Point>& points() const { return points_; }
  /// Evaluates the profile at successive positions near each other. Each search starts at the
  /// result of the last one.
  class Walk;
  /// Returns the points with s0 <= s <= s1.
  std::span<const Point> points_between(double s0, double s1) const;
  bool empty() const { return points_.empty(); }
  double begin() const { return points_.front().s; }
  double end() const { return points_.back().s; }
  /// Returns the largest absolute height, m.
  double reach() const { return reach_; }

 private:
  using Place = std::vector<Point>::const_iterator;

  Place first_from(double s) const;
  /// Returns the first point that is not before s. The search starts at `near`, which is fast if s
  /// is close to it.
  Place first_from(double s, Place near) const;
  Place search(double s, Place from, Place to) const;
  Value at(double s, Place right) const;
  double area(double s, Place right) const;

  std::vector<Point> points_;
  std::vector<double> areas_;         // integral of the height from the start to each point
  std::vector<double> slopes_;        // slope of the edge after each point; 0 for vertical flanks
  std::vector<Extremes> of_several_;  // lowest and highest z of each group of sixteen points
  /// The range of s is divided into equal parts, one per interval between points. This table holds
  /// the index of the first point after the start of each part. It is empty if there are few
  /// points.
  std::vector<int> first_in_;
  bool even_ = false;  // true: the points are evenly spaced, so part i starts at point i
  double parts_per_meter_ = 0.0;
  double reach_ = 0.0;
};

class Profile::Walk {
 public:
  explicit Walk(const Profile& profile) : profile_(&profile), right_(profile.points_.begin()) {}

  /// Returns the same bits as Profile::at().
  Value at(double s) {
    right_ = profile_->first_from(s, right_);
    return profile_->at(s, right_);
  }
  /// Returns the integral of the height from the start to s, which must be the last position
  /// evaluated.
  double area_to(double s) const { return profile_->area(s, right_); }

 private:
  const Profile* profile_;
  Place right_;
};

/// Returns the first point that is not before s. If there are many points, a table gives the first
/// point of the part that contains s, and the search goes forward from there, or backward by what
/// rounding may require.
inline Profile::Place Profile::first_from(double s) const {
  auto from = points_.begin();
  auto to = points_.end();
  if (!first_in_.empty()) {
    if (!(s > begin())) return from;
    if (s > end()) return to;
    const auto part = static_cast<std::size_t>((s - begin()) * parts_per_meter_);
    const std::size_t of = std::min(part, first_in_.size() - 1);
    from += even_ ? static_cast<int>(of) : first_in_[of];
    while (from != points_.begin() && !((from - 1)->s < s)) --from;
    constexpr int kNear = 4;
    for (int i = 0; i < kNear; ++i, ++from)
      if (!(from->s < s)) return from;
    if (part + 2 < first_in_.size()) to = points_.begin() + first_in_[part + 2];
  }
  return search(s, from, to);
}

inline Profile::Place Profile::first_from(double s, Place near) const {
  if (!first_in_.empty()) return first_from(s);
  if (near == points_.end() || !(near->s < s)) {
    while (near != points_.begin() && !((near - 1)->s < s)) --near;
    return near;
  }
  do ++near;
  while (near != points_.end() && near->s < s);
  return near;
}

inline Profile::Value Profile::at(double s, Place right) const {
  if (points_.empty()) return {};
  if (right == points_.end()) return {points_.back().z, 0.0};
  if (right->s > s) {
    if (right == points_.begin()) return {right->z, 0.0};
    const auto left = right - 1;
    const double slope = slopes_[static_cast<std::size_t>(left - points_.begin())];
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

inline double Profile::area(double s, Place right) const {
  if (right == points_.begin()) return (s - right->s) * right->z;
  const auto left = right - 1;
  const auto i = static_cast<std::size_t>(left - points_.begin());
  // The slope stored for the last point is 0, since the profile is level beyond its end.
  const double way = s - left->s;
  return areas_[i] + way * (left->z + 0.5 * slopes_[i] * way);
}

/// Returns the profile of a bar with the given length, whose middle is at s = 0. A bevel of 45 deg
/// removes `bevel` from its upper edges along both directions; the flanks below are vertical. A
/// negative height is a groove with beveled rim. Requires length > 0 and 0 <= bevel <=
/// min(|height|, length / 2).
Profile cleat_profile(double height, double length, double bevel);

/// Returns the profile with rounded corners. Each corner has its radius (0: sharp), which is
/// reduced if the arc would use more than half of the shorter adjacent edge. The arcs consist of
/// chords of at most 5 deg.
Profile rounded_profile(const std::vector<Profile::Point>& points,
                        const std::vector<double>& radii);

}  // namespace latsch::road
