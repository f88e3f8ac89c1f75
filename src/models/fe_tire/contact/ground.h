// SPDX-License-Identifier: Apache-2.0
// The rigid ground on which the tire stands, and its pose.
//
// The ground is flat or has one bar on it: a cleat, or a plank if it is long. It is the graph of a
// height h(x, y) in its own axes, z upward. A point of the tread at (x, y, z) there has, to first
// order, the normal distance g and normal n
//   g = (z - h) / sqrt(1 + |grad h|^2),   n = (-h_x, -h_y, 1) / sqrt(1 + |grad h|^2)          (G.1)
// The force on a bevel therefore acts along the bevel's normal. The vertical sides of a bar cause
// no force: a tread that bends over a bar spans the corner beside it.
//
// The wheel's frame is that of mesh.h. A pose consists of the settings of the rig: the height of
// the wheel center over the ground, the position of the ground's origin below it, the wheel's
// camber and the ground's yaw.
//
// When points begin or cease to touch, loads have kinks and modes jump. Between two such events the
// tire is on one branch. `held` continues this branch: exactly the given points are in contact,
// under pressure or tension, and no others. On this branch loads are smooth. Where free contact has
// the same touching points, both have the same values and derivatives.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace latsch::fe_tire {

/// A bar on the ground, centered at the ground's origin.
struct Bar {
  double height = 0.0, length = 0.0;  // m; the length is along the road if the angle is 0
  double bevel = 0.0;                 // m, 45 degree bevel of the upper edges
  double angle = 0.0;                 // rad, angle between bar and axle
  bool operator==(const Bar&) const = default;
};

/// Points of the tread that touch, with ascending indices. They are numbered in one window, the
/// part of the tread that may touch (FeTire::touching).
struct TouchingPoints {
  int window = 0;           // index of the window (TireState::window)
  std::vector<int> points;  // indices of tread points
  bool operator==(const TouchingPoints&) const = default;
};

/// Rigid ground with penalty contact and Coulomb friction.
struct Ground {
  double stiffness = 2.0e10;    // normal penalty, Pa/m
  double mu = 0.0;              // friction coefficient; 0: frictionless
  std::optional<Bar> bar = {};  // bar on the ground; not set: the ground is flat
  /// Points that are in contact at any distance from the ground, while no others are. This is
  /// possible only on flat ground without friction. Not set: points below the ground's surface are
  /// in contact.
  std::optional<TouchingPoints> held = {};
  bool operator==(const Ground&) const = default;
};

/// Pose of the ground relative to the wheel.
struct GroundPose {
  double height = 0.0;  // m, height of the wheel center above the ground, along the ground's normal
  /// Position of the ground's origin relative to the point below the wheel center, m.
  double x = 0.0, y = 0.0;
  /// Inclination of the wheel to the ground about x, rad; positive: top to the right.
  double camber = 0.0;
  double yaw = 0.0;  // rad, rotation of the ground about its normal

  /// Returns true if a rotation by half a turn about the vertical through the wheel center leaves
  /// the ground unchanged.
  bool is_below() const { return x == 0.0 && y == 0.0 && camber == 0.0; }
  bool operator==(const GroundPose&) const = default;
};

/// Returns the pose at a share (0 to 1) of the path from a to b.
GroundPose between(const GroundPose& a, const GroundPose& b, double share);

/// The ground in a pose. It converts between the ground's axes and the wheel frame.
class PosedGround {
 public:
  /// Makes the ground in this pose.
  PosedGround(const Ground& ground, const GroundPose& pose);

  /// Converts a point p from the wheel frame to the ground's axes, m.
  Eigen::Vector3d in_ground(const Eigen::Vector3d& p) const { return R_ * p + shift_; }
  /// Rotates a vector from the ground's axes to the wheel frame.
  Eigen::Vector3d to_wheel(const Eigen::Vector3d& v) const { return R_.transpose() * v; }

  /// Distance of a point from the ground, and the ground's normal there.
  struct Distance {
    double g;           // m, negative inside the ground
    Eigen::Vector3d n;  // unit normal in the ground's axes
  };
  /// Returns the distance of a point q, given in the ground's axes, from the ground.
  Distance distance(const Eigen::Vector3d& q) const;

 private:
  std::optional<Bar> bar_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d shift_;
  Eigen::Vector2d along_;  // horizontal unit vector along which the bar's height varies
};

}  // namespace latsch::fe_tire
