// SPDX-License-Identifier: Apache-2.0
// Internals of RollingTransient, which moves on in time (rolling_transient.cpp) and from whose
// steady state the reduced tire is made (reduced_tire.cpp).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "models/fe_tire/analysis/fe_tire_impl.h"
#include "models/fe_tire/motion/moving_inertia.h"
#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/passage/rolling_transient.h"
#include "models/fe_tire/passage/transient_history.h"
#include "models/fe_tire/rolling/linear_roller.h"

namespace latsch::fe_tire {

/// The whole ring with its tread, its present state, and its present tangent.
struct RollingTransient::Impl {
  FeTire& tire;
  const RingElements& elements;
  RingUnknowns unknowns;
  TreadSurface tread;
  RingAssembly assembly;
  TreadLines lines;
  MovingInertia inertia;
  numerics::SymmetricMatrix K, M, W;
  LinearRoller linear;
  std::optional<TransientHistory> history;  // none: the tire is elastic
  RollingTransientSettings settings;
  double touching;  // rad
  TransientState now;
  /// The tangent whose factorization is kept, null if there is none, and the time step, s, for
  /// which the tangent was built.
  std::shared_ptr<const numerics::SymmetricMatrix> factored;
  double factored_step = 0.0;

  Impl(FeTire& of, const RingElements& with, TreadShape shape, double angle)
      : tire(of),
        elements(with),
        unknowns(with.ring(), RingSymmetry::none, {}),
        tread(unknowns, shape, angle),
        assembly(unknowns),
        lines(tread, with.ring().mesh()),
        inertia(with),
        K(*assembly.pattern()),
        M(assembly.mass(with)),
        W(flow_stiffness(assembly, with)),
        linear(assembly, tread, lines),
        touching(angle) {}

  /// An iterate of a step.
  struct Iterate {
    BossakStep::Motion motion;
    Eigen::VectorXd alpha;
    Eigen::VectorXd f;  // N, internal forces
    Eigen::VectorXd g;  // N, forces of (V.5) without the ground
    MovingInertia::Forces inertia;
    double spin = 0.0, spin_rate = 0.0;
  };
  /// Distance from the axle, m, up to which the ground may reach.
  double reach() const;
  Status find_stiffness(const std::vector<double>& m);
  void forget() {
    linear.forget();
    factored.reset();
  }
  Status use_tangent();
  Eigen::Matrix3Xd of_turning(const Iterate& at, const WheelMoment& to) const;

  Status evaluate(Iterate& at, const BossakStep& rule, const WheelMoment& to, bool with_tangent);
  void add_inertia(Iterate& at, const BossakStep& rule, const WheelMoment& to) const;
  Status renew(Iterate& at, const BossakStep& rule, const WheelMoment& to);
  Result<double> move(Iterate& at,
                      const BossakStep& rule,
                      const WheelMoment& to,
                      const LinearRoller::Found& found);
  double spin_rate_of(const Iterate& at,
                      const SpinningWheel& wheel,
                      const LinearRoller::Found& found) const;
  TransientForces forces(const Iterate& at,
                         const RollingCase& of,
                         const RollingForces& ground) const;
  Result<TransientForces> step(const WheelMoment& to, double h);
};

}  // namespace latsch::fe_tire
