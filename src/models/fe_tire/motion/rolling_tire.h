// SPDX-License-Identifier: Apache-2.0
// Steady rolling of the finite-element tire on flat ground.
//
// The mesh stands and the tire runs through it: displacements are constant in time, and the ground
// passes by with V_g (rolling_grip.h). The equations are (6) of docs/fe_tire_solution.md,
//   g - K d + c(u(x - d)) = 0,
// on the whole ring, since rolling with grip has no symmetry. c is the ground's pressure, by the
// penalty (C.1), and the friction of rolling (F.1) along the lines of the tread's points in the
// order of flow. K is eliminated down to the nodes below which the ground may be; there the friction
// is solved with its own Jacobian, dense and not symmetric, by the active set of rolling_contact.h.
//
// In (F.1) the time between two points is that of their material angles, Delta theta/Omega, where
// the angle of a mean (T.1) is the mean of its planes' angles with the same weights. A tread that
// rolls without slip then has no creep, whatever the width of the sectors.
//
// Material without history is elastic: rolling resistance is friction's alone. Inertia of the
// spinning tire is left out, so results hold for slow rolling.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/rolling_contact.h"

namespace latsch::fe_tire {

/// Motion of the wheel and how it is driven. Axes stand on the ground and head as the wheel does:
/// ISO, x forward, y left, z up.
struct RollingCase {
  double height = 0.0;      // m, wheel center over the ground
  double speed = 0.0;       // m/s, size of the wheel center's velocity, positive
  double spin = 0.0;        // rad/s, Omega about +y of the wheel; forward rolling is positive
  double slip_angle = 0.0;  // rad, tan alpha = V_y/V_x
  double camber = 0.0;      // rad, about x: top to the right
  double turn_slip = 0.0;   // 1/m, -(turning rate of the heading)/V
  RollingFriction friction;
  bool has_friction = true;
};

/// A point of the tread in contact.
struct RollingPatchPoint {
  double x, y;              // m, from the point below the wheel center
  double pressure;          // Pa
  double shear_x, shear_y;  // Pa, on the tire
  double slide_x, slide_y;  // m/s, velocity over the ground; 0 if it sticks
  double area;              // m^2
  bool sticks;
};

/// Forces of the ground on the tire; moments about the contact center, the point of the ground below
/// the wheel center (TYDEX W).
struct RollingForces {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m
  double spin_moment = 0.0;  // N m, of the ground about the wheel's spin axis; the drive holds it
  double friction_power = 0.0;  // W, lost by sliding
};

/// An equilibrium of the rolling tire, and the work that it took.
struct RollingState {
  RollingCase of;
  double pressure = 0.0;  // Pa
  Eigen::Matrix3Xd u;     // m, [3 x nodes] of the whole ring, sector frames
  Eigen::VectorXd alpha;  // internal parameters of the elements
  GripState grip{0};      // states of all tread points; a start for a neighboring case
  RollingForces forces;
  std::vector<RollingPatchPoint> patch;
  double residual = 0.0;  // N
  int iterations = 0, passes = 0;
};

class TreadBody;

class RollingTire {
 public:
  /// Keeps a reference to the tire; its material values must not change. `element`: that of the
  /// tire.
  RollingTire(FeTire& tire, ElementKind element);
  ~RollingTire();

  /// Returns a start for the first case: the tire pressed to a height without friction.
  Result<RollingState> press(const Inflated& inflated, double height);
  /// Finds the steady state of a case, starting from a neighboring state. A Failure names what did
  /// not converge.
  Result<RollingState> roll(const RollingState& from, const RollingCase& of);

 private:
  struct Impl;
  static void measure(const TreadBody& body,
                      const RollingInput& input,
                      const GripState& states,
                      const GripTractions& t,
                      RollingState& state);
  FeTire& tire_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
