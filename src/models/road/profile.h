// SPDX-License-Identifier: Apache-2.0
// The section of an obstacle: height over a coordinate s, linear between its points.
//
//   cleat:      ____________  height        kerb, saw tooth:      /|   /|   /|
//          bevel/            \                                   / |  / |  / |
//              |              |                                 /  | /  | /  |
//       -------+              +-------  0                      /   |/   |/   |
//
// Two points with the same s form a vertical flank; exactly there the greater of both heights
// counts. Beyond its ends a profile keeps its last height.
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
    double slope = 0.0;   // dz/ds; at a corner the slope of the part behind it
  };

  /// Makes a level profile at zero.
  Profile() = default;
  /// Takes `points` in order of s, which never decreases.
  explicit Profile(std::vector<Point> points);

  Value at(double s) const;
  /// Returns the area below the profile from its start to s, m^2. The profile must not be empty.
  double area(double s) const;
  struct Extremes {
    double lowest, highest;  // m
  };
  /// Returns the extremes over s0 <= s <= s1.
  Extremes between(double s0, double s1) const;
  const std::vector<Point>& points() const { return points_; }
  /// Evaluates successive, nearby positions; each search starts from the last one.
  class Walk;
  /// Returns the points with s0 <= s <= s1.
  std::span<const Point> points_between(double s0, double s1) const;
  bool empty() const { return points_.empty(); }
  double begin() const { return points_.front().s; }
  double end() const { return points_.back().s; }
  /// Returns the largest distance from zero, m.
  double reach() const { return reach_; }

 private:
  using Place = std::vector<Point>::const_iterator;

  Place first_from(double s) const;
  /// The search starts at `near` if s is close to it.
  Place first_from(double s, Place near) const;
  Place search(double s, Place from, Place to) const;
  Value at(double s, Place right) const;
  double area(double s, Place right) const;

  std::vector<Point> points_;
  std::vector<double> areas_;         // area up to each point
  std::vector<double> slopes_;        // slope from each point to the next; 0 for flanks
  std::vector<Extremes> of_several_;  // extremes of z, of sixteen points each
  /// First point behind the start of each of equal parts, one part per point; or empty.
  std::vector<int> first_in_;
  bool even_ = false;  // points are evenly spaced: a part starts at the point with its
                       // number
  double parts_per_meter_ = 0.0;
  double reach_ = 0.0;
};

class Profile::Walk {
 public:
  explicit Walk(const Profile& profile) : profile_(&profile), right_(profile.points_.begin()) {}

  /// Returns the same bits as the profile's at().
  Value at(double s) {
    right_ = profile_->first_from(s, right_);
    return profile_->at(s, right_);
  }
  /// Returns the area up to s, which must be the last place evaluated.
  double area_to(double s) const { return profile_->area(s, right_); }

 private:
  const Profile* profile_;
  Place right_;
};

/// Returns the first point that is not before s. If there are many points, the search starts at the
/// first point of its part, and goes back as far as rounding may require, or forward.
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
  const double way = s - left->s;  // slopes_ of the last point is 0: beyond the end it is level
  return areas_[i] + way * (left->z + 0.5 * slopes_[i] * way);
}

/// Returns a bar of `length` across s = 0. A bevel of 45 deg removes `bevel` from its upper edges
/// along both directions; the flanks below are vertical. A negative height is a groove with beveled
/// rim. Requires length > 0 and 0 <= bevel <= min(|height|, length / 2).
Profile cleat_profile(double height, double length, double bevel);

/// Returns the profile with every corner rounded by its radius (0: sharp), limited by half of the
/// shorter adjacent edge, with chords of at most 5 deg.
Profile rounded_profile(const std::vector<Profile::Point>& points,
                        const std::vector<double>& radii);

}  // namespace latsch::road
