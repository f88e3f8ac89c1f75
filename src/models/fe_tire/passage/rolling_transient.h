// SPDX-License-Identifier: Apache-2.0
// The rolling tire in time: over a bar on the ground or on a drum, after a step of the slip angle,
// with a wheel whose spin follows from its moments.
//
//   RollingTransient passage(tire);
//   passage.start(*free, {.step = 5e-4});                   // a steady state of RollingTire
//   for (...) auto now = passage.advance({.of = there, .ground = &bar, .place = {.way = way}});
//   now->force                                              // of the tire on the hub
//
// The mesh stands and the tire runs through it, as in rolling_tire.h:
//   M a + Omega (G' - G'^T) v + f_int(x) - Omega^2 (w_0 + W u) + Omega' G' x = c              (V.5)
// in axes that travel with the wheel center, whose acceleration adds to a. Axes that turn with w
// add w' x x + w x (w x x) + 2 w x v, with v = Omega e x x + du/dt, in which the strains of the
// material that passes are left out. c is the ground's
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

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/passage/reduced_tire.h"
#include "models/fe_tire/passage/transient_state.h"
#include "models/fe_tire/passage/wheel_moment.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/tread_lines.h"

namespace latsch::fe_tire {

struct RollingTransientSettings {
  double step = 5e-4;  // s
  double rho = 0.7;    // share of high frequencies that is left after each step (bossak_step.h)
  /// Residual of a step, relative to the load at the start, or to a tenth of the pressure on a
  /// square as wide as the tread if that is more.
  double enough = 1e-3;
};

class RollingTransient {
 public:
  /// Keeps a reference to the tire; its material values must not change. `touching`, rad: half
  /// angle of the tread that may touch the ground. A larger one costs larger dense matrices.
  explicit RollingTransient(FeTire& tire, double touching = kTouchingAngle);
  RollingTransient(RollingTransient&&) noexcept;
  ~RollingTransient();

  /// Lets rubber and cords relax by these terms, as RollingTire::set_history() does.
  void set_history(const LossMaterials& losses, const Inflated& round);
  /// Begins with a steady state that RollingTire found with the same history. Returns its forces,
  /// or a Failure that says what is out of range.
  Result<TransientForces> start(const RollingState& steady,
                                const RollingTransientSettings& settings);
  /// Moves on by one step, of the settings or of `step`, s. Another step than the last costs a
  /// factorization. After a Failure the tire is as before the step.
  Result<TransientForces> advance(const WheelMoment& to);
  Result<TransientForces> advance(const WheelMoment& to, double step);

  /// Returns the tire linear about the state with which start() began (reduced_tire.h). No step may
  /// have been made since. A Failure says that the tire is unstable off the ground, or why there
  /// are no modes.
  Result<ReducedTire> reduced(const ReductionSettings& settings);

  /// The state at the end of the last step. With the states of several tires, a tire may be moved
  /// on that was not the last one; resume() then costs a factorization.
  const TransientState& state() const;
  /// Returns the state at the end of the last step and has none until start() or resume().
  TransientState take();
  void resume(TransientState state);
  /// Half angle of the tread that may touch, rad, and half of its width, m.
  double touching() const;
  double half_width() const;
  /// Returns the displacements of the whole ring, m [3 x nodes, sector frames], and their rates.
  Eigen::Matrix3Xd displacements() const;
  Eigen::Matrix3Xd rates() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
