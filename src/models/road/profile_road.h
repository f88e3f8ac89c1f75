// SPDX-License-Identifier: Apache-2.0
// A flat road with an obstacle of constant section, which may repeat: a cleat or plank across the
// road, a kerb along it.
//
// The section is attached to a line through `origin`, turned by `angle` about z. s runs along this
// line, t to its left:
//   s = (x - x0 + travel of the belt) cos(angle) + (y - y0) sin(angle),
//   z = along(s) across(t).
// At angle 0 this is a cleat parallel to the axle. With a pitch, along(s) on 0 ... pitch repeats,
// `count` times or forever; where two repetitions meet, the later one counts. `across` is a factor;
// without it the factor is 1. Outside its obstacle the road is level and infinite.
#pragma once

#include <algorithm>
#include <optional>

#include "models/road/profile.h"
#include "models/road/road.h"
#include "models/road/travel.h"

namespace latsch::road {

class ProfileRoad final : public Road {
 public:
  /// The obstacle's sections, its position, its repetition and the friction.
  struct Settings {
    Profile along = {};  // height over the distance along the road, m
    /// Height factor over the distance across the road; not set: 1.
    std::optional<Profile> across = std::nullopt;
    double pitch = 0.0;  // m, length of a repetition; 0: the obstacle does not repeat
    int count = 0;       // number of repetitions; 0: infinite on both sides
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // m
    double angle = 0.0;                                // rad
    double friction = 1.0;                             // friction factor beside the obstacle
    double obstacle_friction = 1.0;                    // friction factor on the obstacle
    Travel belt = {};                                  // motion of the whole road toward -x
  };

  /// Makes a road with these settings.
  explicit ProfileRoad(const Settings& settings);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  /// Returns the exact mean height along the line, which is computed piecewise because the height
  /// is a quadratic polynomial between corners.
  double mean_height(const Eigen::Vector2d& from,
                     const Eigen::Vector2d& to,
                     double time) const override;
  void below(const GroundRow& row, double time, const RowGround& ground) const override;
  GroundBounds bounds(const GroundBox& box, double time) const override;

 private:
  struct Place {
    Profile::Value along, across;
    bool on_obstacle = false;
  };
  struct Span {
    double from, to;

    void add(double at) {
      from = std::min(from, at);
      to = std::max(to, at);
    }
  };
  GroundBounds bounds_between(Span s, Span t) const;
  struct RowPlaces;
  /// For the pieces [first, end) of a row: place() determines the positions of the pieces and their
  /// borders, look_up() the profiles there, describe() the resulting ground.
  void place(const GroundRow& row, int first, int end, double time, RowPlaces& places) const;
  void look_up(RowPlaces& places) const;
  void describe(const GroundRow& row,
                int first,
                int end,
                double time,
                const RowPlaces& places,
                const RowGround& ground) const;
  /// Returns s and t of the position x, y.
  Eigen::Vector2d local(double x, double y, double time) const;
  double number_at(double s) const;
  /// Returns the mean height from the integral of one profile, if the line stays in one repetition
  /// and the profile across is constant along it. Otherwise returns nothing.
  std::optional<double> mean_along(const Eigen::Vector2d& begin, const Eigen::Vector2d& way) const;
  bool is_on_obstacle(double s, double t) const;
  Place locate(const Eigen::Vector2d& local) const;
  double height_at(const Eigen::Vector2d& local) const;

  Settings settings_;
  double cos_, sin_;
};

/// Returns a road with a bar across it at x [cleat_profile]. At angle 0 the bar is parallel to the
/// axle.
ProfileRoad cleat_road(double x, double height, double length, double bevel, double angle = 0.0);

}  // namespace latsch::road
