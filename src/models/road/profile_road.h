// SPDX-License-Identifier: Apache-2.0
// A flat road with obstacles of one section: a cleat or plank across it, a kerb along it.
//
// The section stands on a line through `origin` turned by `angle` about z: s runs along it, t
// to its left,
//   s = (x - x0 + way of the belt) cos(angle) + (y - y0) sin(angle),
//   z = along(s) across(t),
// so angle 0 is a cleat parallel to the axle. With a pitch, along(s) on 0 ... pitch repeats,
// `count` times or forever; where two of them meet, the later one counts. `across` is a factor:
// none is 1 everywhere. A road of its own cleat is level elsewhere, without end.
#pragma once

#include <algorithm>
#include <optional>

#include "models/road/profile.h"
#include "models/road/road.h"
#include "models/road/travel.h"

namespace latsch::road {

class ProfileRoad final : public Road {
 public:
  struct Settings {
    Profile along = {};
    std::optional<Profile> across = std::nullopt;
    double pitch = 0.0;  // m; 0: the section stands there once
    int count = 0;       // of the repetitions; 0: no end on both sides
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // m
    double angle = 0.0;                                // rad
    double friction = 1.0;                             // factor, beside the obstacle
    double obstacle_friction = 1.0;                    // factor, on it
    Travel belt = {};                                  // carries everything toward -x
  };

  explicit ProfileRoad(const Settings& settings);

  GroundPoint at(double x, double y, double time) const override;
  double height(double x, double y, double time) const override;
  /// Exact: between corners the height is of second degree.
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
  /// Where the pieces [first, end) of a row and their borders are, what is there, what that means.
  void place(const GroundRow& row, int first, int end, double time, RowPlaces& places) const;
  void look_up(RowPlaces& places) const;
  void describe(const GroundRow& row,
                int first,
                int end,
                double time,
                const RowPlaces& places,
                const RowGround& ground) const;
  /// s and t of a place.
  Eigen::Vector2d local(double x, double y, double time) const;
  double number_at(double s) const;
  /// The mean height by the area below one repetition, where the way stays on it and the section
  /// across is level there.
  std::optional<double> mean_along(const Eigen::Vector2d& begin, const Eigen::Vector2d& way) const;
  bool is_on_obstacle(double s, double t) const;
  Place locate(const Eigen::Vector2d& local) const;
  double height_at(const Eigen::Vector2d& local) const;

  Settings settings_;
  double cos_, sin_;
};

/// A bar across the road at x, parallel to the axle at angle 0 [cleat_profile].
ProfileRoad cleat_road(double x, double height, double length, double bevel, double angle = 0.0);

}  // namespace latsch::road
