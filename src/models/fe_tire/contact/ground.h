// SPDX-License-Identifier: Apache-2.0
// What the tire stands on: a rigid surface and where it is.
//
// The ground is flat or has one bar on it: a cleat, or where it is long a plank. It is the graph of
// a height h(x, y) in its own axes, z upward; a point of the tread at (x, y, z) there has the
// normal distance, to first order in it,
//   g = (z - h) / sqrt(1 + |grad h|^2),   n = (-h_x, -h_y, 1) / sqrt(1 + |grad h|^2)          (G.1)
// so bevels push along their normals, and the upright sides of a bar do not push: a tread that
// bends over a bar spans the corner beside it.
//
// The wheel's frame is the one of mesh.h. A pose is what the rig sets: how high the wheel center is
// over the ground, where below it the ground's origin lies, the wheel's camber and the ground's
// yaw.
//
// As points come to touch and leave, loads have kinks and modes jumps. Between two of them the tire
// is on one branch, and `held` goes on with it: these points touch, pushed or pulled, and no
// others. It is smooth, with the same values and slopes where these are the points that touch.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace latsch::fe_tire {

/// A bar on the ground through its origin, symmetric to it.
struct Bar {
  double height = 0.0, length = 0.0;  // m; length: along the road where angle is 0
  double bevel = 0.0;                 // m, of the upper edges at 45 degrees
  double angle = 0.0;                 // rad, against the axle
  bool operator==(const Bar&) const = default;
};

/// Points of the tread, ascending, in the numbers of a state's window (FeTire::touching).
struct TouchingPoints {
  int window = 0;
  std::vector<int> points;
  bool operator==(const TouchingPoints&) const = default;
};

/// Rigid ground under penalty contact and Coulomb friction.
struct Ground {
  double stiffness = 2.0e10;  // normal penalty, Pa/m
  double mu = 0.0;            // friction coefficient; 0: frictionless
  std::optional<Bar> bar = {};
  /// Whatever their distance, these touch and no others; none: those in the ground. On flat ground
  /// without friction.
  std::optional<TouchingPoints> held = {};
  bool operator==(const Ground&) const = default;
};

struct GroundPose {
  double height = 0.0;      // m, of the wheel center over the ground, along the ground's normal
  double x = 0.0, y = 0.0;  // m, of the ground's origin from the point below the wheel center
  double camber = 0.0;      // rad, of the wheel against the ground, about x: top to the right
  double yaw = 0.0;         // rad, of the ground about its normal

  /// Whether the half turn about the vertical through the wheel center leaves the ground as it is.
  bool is_below() const { return x == 0.0 && y == 0.0 && camber == 0.0; }
  bool operator==(const GroundPose&) const = default;
};

/// On the way from a to b, share 0 to 1.
GroundPose between(const GroundPose& a, const GroundPose& b, double share);

/// The ground in a pose, as points of the wheel frame see it.
class PosedGround {
 public:
  PosedGround(const Ground& ground, const GroundPose& pose);

  /// p of the wheel frame in the ground's axes, m.
  Eigen::Vector3d in_ground(const Eigen::Vector3d& p) const { return R_ * p + shift_; }
  /// Turns a vector of the ground's axes into the wheel frame.
  Eigen::Vector3d to_wheel(const Eigen::Vector3d& v) const { return R_.transpose() * v; }

  struct Distance {
    double g;           // m, negative in the ground
    Eigen::Vector3d n;  // ground's axes
  };
  /// Of a point in the ground's axes.
  Distance distance(const Eigen::Vector3d& q) const;

 private:
  std::optional<Bar> bar_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d shift_;
  Eigen::Vector2d along_;  // of the bar's section
};

}  // namespace latsch::fe_tire
