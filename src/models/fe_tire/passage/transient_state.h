// SPDX-License-Identifier: Apache-2.0
// The state of a tire that rolls in time, as a value: it can be copied, kept and gone back to. It
// belongs to the RollingTransient that made it and must not outlive it.
#pragma once

#include <memory>
#include <optional>

#include "models/fe_tire/grip/tread_past.h"
#include "models/fe_tire/passage/bossak_step.h"
#include "models/fe_tire/passage/transient_history.h"
#include "models/fe_tire/passage/wheel_moment.h"
#include "numerics/sparse/symmetric_matrix.h"

namespace latsch::fe_tire {

struct TransientState {
  BossakStep::Motion motion;
  Eigen::VectorXd alpha;  // internal parameters of the elements
  GripState grip{0};
  std::optional<TreadPast> past;
  double spin = 0.0, spin_rate = 0.0;  // rad/s, rad/s^2
  WheelMoment wheel;                   // without ground
  TransientHistory::Memory history;
  double pressure = 0.0, load = 1.0;  // Pa; N, to which residuals are relative
  double first_spin = 0.0;            // rad/s, at the start
  /// The tangent whose factorization the next step begins with, for steps of the length
  /// `factored_step`, s; none: it is made anew. With it a step from a state has one result,
  /// whatever other states were moved on in between.
  std::shared_ptr<const numerics::SymmetricMatrix> tangent;
  double factored_step = 0.0;
};

}  // namespace latsch::fe_tire
