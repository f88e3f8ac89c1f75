// SPDX-License-Identifier: Apache-2.0
// The rolling tire in time: over a bar on the ground or on a drum, after a step of the slip angle,
// with a wheel whose spin follows from its moments.
//
//   RollingTransient passage(tire);
//   passage.start(*free, {.step = 5e-4, .bar = bar});      // a steady state of RollingTire
//   for (...) auto now = passage.advance({.of = there, .bar_at = ahead});
//   now->force                                              // of the tire on the hub
//
// The mesh stands and the tire runs through it, as in rolling_tire.h:
//   M a + Omega (G' - G'^T) v + f_int(x) - Omega^2 (w_0 + W u) + Omega' G' x = c              (V.5)
// in axes that travel with the wheel center, whose acceleration adds to a. c is the ground's
// pressure (C.1) and friction in time, (F.5) of tread_past.h. Steps are those of bossak_step.h. The
// steady state is the start without any run-in, because it solves (V.5), and (F.5) is (F.1) there.
//
// Newton's method has the symmetric part of the tangent, K + M (1 - alpha)/(beta h^2) - Omega^2 W,
// which is factorized at the start and again only if iterations become slow. Contact is solved in
// each iteration on the tire linear about the iterate (linear_roller.h), so it limits no step. The
// gyroscopic part and the history of stresses that vary within a sector are left to the iterations,
// which converge linearly; two steps that follow each other by one ratio are summed as a geometric
// series. A step without an equilibrium is made in halves.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/grip/passing_bar.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/rolling/rolling_case.h"

namespace latsch::fe_tire {

struct RollingTransientSettings {
  double step = 5e-4;    // s
  double rho = 0.7;      // share of high frequencies that is left after each step (bossak_step.h)
  double enough = 1e-3;  // residual of a step, relative to the load at the start
  std::optional<PassingBar::Size> bar = {};
};

/// A wheel that spins freely, or under a moment besides that of the tire.
struct SpinningWheel {
  double inertia = 1.0;  // kg m^2, of all that spins but the tire
  double moment = 0.0;   // N m, about +y, at the end of the step
};

/// The wheel at the end of a step.
struct WheelMoment {
  RollingCase of;       // load and drive are not used; turn slip has to be 0
  double bar_at = 0.0;  // m, arc to the bar's middle ahead of the wheel center
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // m/s^2, of the center, wheel axes
  /// Set: the spin of `of` is not used, it follows from the moments.
  std::optional<SpinningWheel> wheel = {};
};

/// Forces of the tire at the end of a step.
struct TransientForces {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // N, on the hub, axes of the wheel (TYDEX C)
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // N m, on the hub, about its center
  RollingForces ground;                              // forces of the ground on the tire
  double spin = 0.0;                                 // rad/s
  int iterations = 0, factors = 0, passes = 0;       // work of the step
};

class RollingTransient {
 public:
  /// Keeps a reference to the tire; its material values must not change.
  explicit RollingTransient(FeTire& tire);
  RollingTransient(RollingTransient&&) noexcept;
  ~RollingTransient();

  /// Lets rubber and cords relax by these terms, as RollingTire::set_history() does.
  void set_history(const LossMaterials& losses, const Inflated& round);
  /// Begins with a steady state that RollingTire found with the same history. Returns its forces,
  /// or a Failure that says what is out of range.
  Result<TransientForces> start(const RollingState& steady,
                                const RollingTransientSettings& settings);
  /// Moves on by one step. After a Failure the tire is as before the step.
  Result<TransientForces> advance(const WheelMoment& to);
  /// Returns the displacements of the whole ring, m [3 x nodes, sector frames], and their rates.
  Eigen::Matrix3Xd displacements() const;
  Eigen::Matrix3Xd rates() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
