// SPDX-License-Identifier: Apache-2.0
// The rigid ground on which the tire stands, and its pose.
//
// The ground is flat or has one bar on it: a cleat, or a plank if it is long. It is the graph of a
// height h(x, y) in its own axes, z upward. A point of the tread at (x, y, z) there has, to first
// order, the normal distance g and normal n
//   g = (z - h) / sqrt(1 + |grad h|^2),   n = (-h_x, -h_y, 1) / sqrt(1 + |grad h|^2)          (G.1)
// Bevels therefore push along their normals, and the upright sides of a bar do not push: a tread
// that bends over a bar spans the corner beside it.
//
// The wheel's frame is that of mesh.h. A pose is what the rig sets: the height of the wheel center
// over the ground, the position of the ground's origin below it, the wheel's camber and the
// ground's yaw.
//
// When points begin or cease to touch, loads have kinks and modes jump. Between two such events the
// tire is on one branch. `held` continues this branch: the given points touch, pushed or pulled,
// and no others. The branch is smooth, with the same values and slopes as free contact in which
// these points touch.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace latsch::fe_tire {

/// A bar through the ground's origin, symmetric to it.
struct Bar {
  double height = 0.0, length = 0.0;  // m; length: along the road if angle is 0
  double bevel = 0.0;                 // m, 45 degree bevel of the upper edges
  double angle = 0.0;                 // rad, against the axle
  bool operator==(const Bar&) const = default;
};

/// Points of the tread, ascending, numbered as in the window of a state (FeTire::touching).
struct TouchingPoints {
  int window = 0;           // TireState::window
  std::vector<int> points;  // indices of tread points
  bool operator==(const TouchingPoints&) const = default;
};

/// Rigid ground under penalty contact and Coulomb friction.
struct Ground {
  double stiffness = 2.0e10;    // normal penalty, Pa/m
  double mu = 0.0;              // friction coefficient; 0: frictionless
  std::optional<Bar> bar = {};  // a bar on the ground; none: the ground is flat
  /// Points that touch, and no others, whatever their distance; only on flat ground without
  /// friction. None: the points below the ground's surface touch.
  std::optional<TouchingPoints> held = {};
  bool operator==(const Ground&) const = default;
};

/// Pose of the ground, seen from the wheel.
struct GroundPose {
  double height = 0.0;      // m, wheel center over the ground, along the ground's normal
  double x = 0.0, y = 0.0;  // m, ground's origin from the point below the wheel center
  double camber = 0.0;      // rad, wheel against the ground, about x: top to the right
  double yaw = 0.0;         // rad, ground about its normal

  /// True if the half turn about the vertical through the wheel center leaves the ground unchanged.
  bool is_below() const { return x == 0.0 && y == 0.0 && camber == 0.0; }
  bool operator==(const GroundPose&) const = default;
};

/// Returns the pose on the path from a to b at this share, 0 to 1.
GroundPose between(const GroundPose& a, const GroundPose& b, double share);

/// The ground in a pose, seen from the wheel frame.
class PosedGround {
 public:
  /// Places this ground in this pose.
  PosedGround(const Ground& ground, const GroundPose& pose);

  /// Returns the point p of the wheel frame in the ground's axes, m.
  Eigen::Vector3d in_ground(const Eigen::Vector3d& p) const { return R_ * p + shift_; }
  /// Turns a vector from the ground's axes into the wheel frame.
  Eigen::Vector3d to_wheel(const Eigen::Vector3d& v) const { return R_.transpose() * v; }

  /// Distance of a point from the ground, and its normal.
  struct Distance {
    double g;           // m, negative in the ground
    Eigen::Vector3d n;  // ground's axes
  };
  /// Returns the distance of a point given in the ground's axes.
  Distance distance(const Eigen::Vector3d& q) const;

 private:
  std::optional<Bar> bar_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d shift_;
  Eigen::Vector2d along_;  // direction of the bar's section
};

}  // namespace latsch::fe_tire
