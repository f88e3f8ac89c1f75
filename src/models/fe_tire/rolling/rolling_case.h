// SPDX-License-Identifier: Apache-2.0
// Steady rolling of the finite-element tire: motion that is asked for, and the state found.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/fe_tire/grip/rolling_grip.h"

namespace latsch::fe_tire {

/// Motion of the wheel on flat ground or a drum, and how it is driven. Axes stand on the ground and
/// head as the wheel does: ISO, x forward, y left, z up (TYDEX W). On a drum, z = 0 is the plane
/// that touches its top line, below the wheel center, and speeds are those of its surface.
struct RollingCase {
  double speed = 0.0;       // m/s, size of the wheel center's velocity, positive
  double slip_angle = 0.0;  // rad, tan alpha = V_y/V_x, below 90 degrees
  double camber = 0.0;      // rad, about x: top to the right
  double turn_slip = 0.0;   // 1/m, -(turning rate of the heading)/V
  double curvature = 0.0;   // 1/m, of a drum below the tire; 0: flat ground
  double height = 0.0;      // m, wheel center over the ground; a start if a load is asked for
  double spin = 0.0;        // rad/s, Omega about +y; a start if a drive is asked for
  std::optional<double> load = {};   // N, Fz that the height has to give
  std::optional<double> drive = {};  // N m, moment of the drive about +y that the spin has to give;
                                     // 0: free rolling
  RollingFriction friction = {};     // at_rest = 0: none
};

/// Returns the case on the path from a to b at this share, 0 to 1, with the friction of b.
RollingCase between(const RollingCase& a, const RollingCase& b, double share);

/// A point of the tread in contact.
struct RollingPatchPoint {
  double x, y;              // m, from the contact center; on a drum the surface is rolled out
  double pressure;          // Pa
  double shear_x, shear_y;  // Pa, on the tire
  double slide_x, slide_y;  // m/s, velocity over the ground; 0 if it sticks
  double area;              // m^2
  bool sticks;
  double limit;   // Pa, mu p
  double length;  // m, of the point's area around; the rest of the area is its width
  int line;       // index of its line around, from 0
};

/// Forces of the ground on the tire; moments about the contact center, where the wheel's middle
/// plane, the ground and the vertical plane through the spin axis meet (TYDEX W).
struct RollingForces {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m
  /// Sum of the tractions, N, x and y on the surface rolled out. On flat ground it is that of
  /// `force`; R times it is the moment that brakes a drum.
  Eigen::Vector2d traction = Eigen::Vector2d::Zero();
  double drive = 0.0;  // N m, moment of the drive about the spin axis, which holds the wheel
  double friction_power = 0.0;  // W, lost by sliding
};

/// An equilibrium of the rolling tire, and the work that it took.
struct RollingState {
  RollingCase of;         // height and spin: those found
  double pressure = 0.0;  // Pa
  Eigen::Matrix3Xd u;     // m, [3 x nodes] of the whole ring, sector frames
  Eigen::VectorXd alpha;  // internal parameters of the elements
  /// The state before on a path, from which the next one is predicted: its displacements, empty if
  /// there is none, and its case.
  Eigen::Matrix3Xd u_before;
  RollingCase of_before;
  GripState grip{0};  // states of all tread points; a start for a neighboring case
  RollingForces forces;
  std::vector<RollingPatchPoint> patch;
  double residual = 0.0;  // N
  int iterations = 0;     // passes over the elements
  int factors = 0;        // factorizations
  int passes = 0;         // solutions of the contact patch
  int parts = 0;          // parts of the path from the state before

  /// Distance of the wheel center from the contact center, m.
  double loaded_radius() const;
};

}  // namespace latsch::fe_tire
