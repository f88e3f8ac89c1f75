// SPDX-License-Identifier: Apache-2.0
// Spring, damper and inerter between points of bodies, along the line through them.
//   e = Σ w (|p_b - p_a| - L0) - s        extension against rest; s: a driver's, m
//   F = F0 + k e + c e' + b e'' + parts   tension, N
//   F = F0 + k e + c e' + b e'' + parts   tension, N
// With one line this is a spring-damper unit, a bump stop (a curve that acts below an extension),
// an actuator or a rigid bar. With two it acts on their sum or difference: a third element in heave
// (weights +1, +1), an anti-roll bar driven by its drop links (+1, -1). The force on a body is -F
// ∂e/∂x; the tangent includes the lines' rotation.
#pragma once

#include <string>
#include <vector>

#include "models/multibody/force_part.h"
#include "models/multibody/pose.h"

namespace latsch::multibody {

struct StrutLine {
  int a, b;                          // indices of bodies, or kGround
  Eigen::Vector3d point_a, point_b;  // at rest, m
  double weight = 1.0;
};

struct Strut {
  std::string name;
  std::vector<StrutLine> lines;
  double stiffness = 0.0;  // k, N/m
  double damping = 0.0;    // c, N s/m
  double inertance = 0.0;  // b, kg
  double preload = 0.0;    // F0, N, at rest; tension is positive
  std::vector<ForcePart> parts = {};
  int driver = -1;  // driver whose value is s; -1: none
};

/// A line in its current position: unit vector from a to b, length, arms from the bodies' origins.
struct LineGeometry {
  Eigen::Vector3d n, arm_a, arm_b;
  double length, weight;

  /// Return ∂e/∂x of both bodies.
  Vector6d by_a() const;
  Vector6d by_b() const;
  /// Returns the line's part of e'' if no body has an acceleration.
  double centripetal(const Vector6d& rate_a, const Vector6d& rate_b) const;
  /// ∂²e/∂x∂x: derivatives of by_a() and by_b(), with columns for travel and rotation of a and b.
  struct Turning {
    Matrix6d aa, ab, ba, bb;
  };
  Turning turning() const;
};

/// `in_a`, `in_b`: points of the line from the bodies' origins, in the bodies' axes.
LineGeometry line_geometry(const Pose& a,
                           const Pose& b,
                           const Eigen::Vector3d& in_a,
                           const Eigen::Vector3d& in_b,
                           double weight);

}  // namespace latsch::multibody
