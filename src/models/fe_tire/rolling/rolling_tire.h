// SPDX-License-Identifier: Apache-2.0
// Steady rolling of the finite-element tire on flat ground, with inertia and friction.
//
//   RollingTire rolling(tire);
//   auto start = rolling.start(pressed);                    // at rest, without friction
//   auto free  = rolling.roll(start, {.speed = 20.0, .load = load, .drive = 0.0,
//                                      .friction = {.at_rest = 1.0}});
//   auto next  = rolling.roll(*free, with_slip);            // from neighbor to neighbor
//
// The mesh stands and the tire runs through it: displacements are constant in time, and the ground
// passes by with V_g (rolling_grip.h). On the whole ring, since friction has no symmetry,
//   f_int(u) - Omega^2 (w_0 + W u) = c(u)                                                    (R.1)
// with the inertia (W.1) of spin.h. c is the ground's pressure, by the penalty (C.1), and the
// friction of rolling (F.1) along the lines of the tread's points in the order of flow.
//
// Newton's method solves (R.1) with the tangent K - Omega^2 W of this or of an earlier state. In
// each iteration K is eliminated down to the nodes below which the ground may be; there the contact
// is solved with its own Jacobian, dense and not symmetric, by the active set of rolling_contact.h,
// on the tire linear about the iterate. So the contact never limits a step, only the elements do.
// Height and spin that follow from a load and a drive are found on this linear tire, too. A case
// far from the last state is approached in parts, which are halved where one does not converge.
//
// In (F.1) the time between two points is that of their material angles, Delta theta/Omega, where
// the angle of a mean (T.1) is the mean of its planes' angles with the same weights. A tread that
// rolls without slip then has no creep, whatever the width of the sectors.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/history/loss_materials.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/tread_lines.h"

namespace latsch::fe_tire {

class RingElements;

/// A number of the tire's description, changed by -step and by +step.
struct RollingCause {
  const RingElements *below, *above;      // elements on the tire's own mesh
  double pressure_below, pressure_above;  // Pa
  std::optional<std::pair<RollingFriction, RollingFriction>> friction;  // none: it stays
  double step;                                                          // in the number's unit
  /// Relative change of the spin per unit; not used if the spin follows from a drive.
  double spin = 0.0;
};

/// Derivatives of a steady state by a number, per unit of the number.
struct RollingRates {
  RollingForces forces;
  double height = 0.0;  // m
  double spin = 0.0;    // rad/s
};

class RollingTire {
 public:
  /// Keeps a reference to the tire; its material values must not change. `touching`, rad: half
  /// angle of the tread that may touch the ground.
  explicit RollingTire(FeTire& tire, double touching = kTouchingAngle);
  ~RollingTire();

  /// Lets rubber and cords relax by these terms: (R.1) then has their history (rolling_history.h).
  /// `round`: the inflated tire, from which stresses count. Without this call, and without terms,
  /// the tire is elastic.
  void set_history(const LossMaterials& losses, const Inflated& round);
  /// Returns a start for the first case: a tire at rest, pressed on flat ground without friction.
  /// The state has to be one of the whole ring (FeTire::Poses::any).
  RollingState start(const TireState& pressed);
  /// Finds the steady state of a case, starting from a neighboring state. A Failure says what did
  /// not converge and how far the path was followed, or which number of the case is out of range.
  Result<RollingState> roll(const RollingState& from, const RollingCase& of);

  /// Returns the derivatives of a steady state of an elastic tire by several numbers, in which load
  /// and drive stay where the state's case has them, else height and spin. Points that stick or
  /// slide go on to do so. A tire with a history gives a Failure.
  Result<std::vector<RollingRates>> rates(const RollingState& of,
                                          const std::vector<RollingCause>& causes);

  /// Discards the kept factorization: the next state then does not depend on those before `from`.
  void forget();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
