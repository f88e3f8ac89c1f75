// SPDX-License-Identifier: Apache-2.0
// Spring, damper and inerter between points of bodies, along the line through them.
//   e = Σ w (|p_b - p_a| - L0) - s        extension relative to rest; s: travel of a driver, m
//   F = F0 + k e + c e' + b e'' + parts   tension, N; L0: length at rest, w: weight of a line
// With one line this is a spring-damper unit, a bump stop (a curve that acts beyond some
// extension), an actuator or a rigid bar. With two lines it acts on the sum or difference of their
// lengths: a third element in heave (weights +1, +1), an anti-roll bar driven by its drop links
// (+1, -1). The force on a body is -F ∂e/∂x; the tangent includes the rotation of the lines.
#pragma once

#include <string>
#include <vector>

#include "models/multibody/force_part.h"
#include "models/multibody/pose.h"

namespace latsch::multibody {

struct StrutLine {
  int a, b;                          // indices of the bodies, or kGround
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
  int driver = -1;  // driver whose travel is s; -1: none
};

/// A strut's line in its current position: unit vector n from a to b, length, and vectors from the
/// bodies' origins to the end points.
struct LineGeometry {
  Eigen::Vector3d n, arm_a, arm_b;
  double length, weight;

  /// Return the derivative ∂e/∂x of the extension with respect to displacement and rotation of body
  /// a or b.
  Vector6d by_a() const;
  Vector6d by_b() const;
  /// Returns the contribution of the line to e'' that comes from the bodies' velocities alone,
  /// without their accelerations.
  double centripetal(const Vector6d& rate_a, const Vector6d& rate_b) const;
  /// Second derivatives ∂²e/∂x∂x: derivatives of by_a() and by_b(), one column per component of
  /// displacement and rotation of a and b.
  struct Turning {
    Matrix6d aa, ab, ba, bb;
  };
  Turning turning() const;
};

/// Returns the geometry of a line. `in_a`, `in_b`: end points relative to the bodies' origins, in
/// the bodies' axes.
LineGeometry line_geometry(const Pose& a,
                           const Pose& b,
                           const Eigen::Vector3d& in_a,
                           const Eigen::Vector3d& in_b,
                           double weight);

}  // namespace latsch::multibody
