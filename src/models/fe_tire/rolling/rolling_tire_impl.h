// SPDX-License-Identifier: Apache-2.0
// Internals of RollingTire, which finds steady states (rolling_tire.cpp) and how they change with
// the tire's numbers (rolling_rates.cpp).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/rolling/linear_roller.h"
#include "models/fe_tire/rolling/rolling_history.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {

/// The whole ring with its tread, and its present tangent.
struct RollingTire::Impl {
  FeTire& tire;
  const RingElements& elements;
  RingUnknowns unknowns;
  TreadSurface tread;
  RingAssembly assembly;
  TreadLines lines;
  numerics::SymmetricMatrix K, W;
  Eigen::VectorXd w_0;
  std::optional<RollingHistory> history;  // none: the tire is elastic
  LinearRoller linear;
  double longest;  // m, motion of a step

  Impl(FeTire& of, const RingElements& with, TreadShape shape, double touching);

  /// An iterate: unknowns and the forces g of (R.1) without the ground.
  struct Iterate {
    AssembledState state;
    Eigen::VectorXd g;
  };
  Result<Iterate> begin(const RollingState& from, RollingCase& of);
  Status evaluate(Iterate& at, double pressure, double spin, bool with_tangent);
  Result<double> advance(Iterate& now, const LinearRoller::Found& found, double pressure);
  Result<LinearRoller::Found> step(
      Iterate& now, const RollingCase& of, double load, double enough, RollingState& state);
  bool is_settled(Iterate& now,
                  const LinearRoller::Found& found,
                  double accepted,
                  RollingState& state);
  Result<RollingState> part(const RollingState& from, const RollingCase& of);
  Result<Eigen::VectorXd> forces(const RollingState& state,
                                 const RingElements& with,
                                 double pressure) const;
};

}  // namespace latsch::fe_tire
