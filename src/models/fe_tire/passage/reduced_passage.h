// SPDX-License-Identifier: Apache-2.0
// The reduced tire (reduced_tire.h) in time, with the contact, the motions and the forces of
// RollingTransient.
//
//   ReducedPassage passage(full);                          // a RollingTransient
//   passage.start(*free, {.step = 5e-4}, {.highest = 300.0});
//   for (...) auto now = passage.advance({.of = there, .ground = &bar, .place = {.way = way}});
//
// Steps are those of bossak_step.h. In a step of the length h the tread's nodes move by
//   w = w_free + F (c - c_0),   F = Phi (a + Omega b G + K)^-1 Phi' + the bracket of (V.8)  (V.10)
// with the step's factors a of the mass and b of the damping and with K as stiff as relaxing parts
// are in one step, so the ground is felt by S = F^-1 as in (R.2). The symmetric part of F serves
// for S, and the forces that are found are inserted in (V.10): what the other part adds is left to
// further iterations, and is small because it acts on the change of c within the iteration alone.
//
// The tire stays as stiff as at its steady state: it does not know that a tire becomes stiffer or
// softer with its deflection, that material of changing spin has changing gyroscopic forces, nor
// products of two rotation rates of the wheel. reduced_states.h compares it with the full tire.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/grip/tread_past.h"
#include "models/fe_tire/passage/bossak_step.h"
#include "models/fe_tire/passage/reduced_tire.h"
#include "models/fe_tire/passage/rolling_transient.h"
#include "models/fe_tire/passage/wheel_moment.h"

namespace latsch::fe_tire {

/// State of a reduced tire in time, as a value. It belongs to the RollingTransient from which the
/// tire was made.
struct ReducedState {
  std::shared_ptr<const ReducedTire> tire;  // null until it is made
  /// Steady state of which the tire is to be made in the first step; null once it is made.
  std::shared_ptr<const TransientState> unreduced;
  BossakStep::Motion q;                         // deviations of the shapes from the steady state
  std::vector<std::vector<Eigen::VectorXd>> y;  // (V.9), [part][term]
  Eigen::VectorXd c;                            // N, forces of the ground on the tread's nodes
  GripState grip{0};
  std::optional<TreadPast> past;
  double spin = 0.0, spin_rate = 0.0;  // rad/s, rad/s^2
  double load = 1.0;                   // N, to which residuals are relative
  double first_spin = 0.0;             // rad/s, at the start
  WheelMoment wheel;                   // without ground
};

class ReducedPassage {
 public:
  /// Keeps a reference to the full tire, of whose steady states reduced ones are made.
  explicit ReducedPassage(RollingTransient& full);
  ReducedPassage(ReducedPassage&&) noexcept;
  ~ReducedPassage();

  /// Begins with a steady state, of which the reduced tire is made. Returns its forces, or a
  /// Failure that says what is out of range.
  Result<TransientForces> start(const RollingState& steady,
                                const RollingTransientSettings& settings,
                                const ReductionSettings& reduction = {});
  /// Begins like start(), but the first step makes the reduced tire. A tire of which only the
  /// steady state is used then costs no reduction.
  Result<TransientForces> begin(const RollingState& steady,
                                const RollingTransientSettings& settings,
                                const ReductionSettings& reduction = {});
  /// Moves on by one step, of the settings or of `step`, s. Another step than the last costs some
  /// hundred milliseconds. After a Failure the tire is as before the step.
  Result<TransientForces> advance(const WheelMoment& to);
  Result<TransientForces> advance(const WheelMoment& to, double step);

  const ReducedState& state() const;
  ReducedState take();
  void resume(ReducedState state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch::fe_tire
