// SPDX-License-Identifier: Apache-2.0
// Belt and sidewall together, with the memory their loops work on, kept from step to step.
#pragma once

#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/belt_damping.h"
#include "models/ring_tire/belt/sidewall.h"

namespace latsch::ring_tire {

class InnerForces {
 public:
  explicit InnerForces(const RingParameters& parameters);

  const BeltForces& belt() const { return belt_; }
  const SidewallForces& sidewall() const { return sidewall_; }
  SidewallForces& sidewall() { return sidewall_; }

  /// What both do to the nodes at q with velocities v, in inertial axes.
  void find_force(const NodeValues& q,
                  const NodeValues& v,
                  const RimFrame& rim,
                  const StepRule& rule,
                  NodeValues& force);
  /// How that falls with q, times scale; until the next.
  StiffnessRows& find_stiffness(const NodeValues& q,
                                const RimFrame& rim,
                                const StepRule& rule,
                                double scale);
  /// C of (30) at q; until the next.
  StiffnessRows& find_belt_damping(const NodeValues& q, const RimFrame& rim);
  /// D of (31) at q with velocities v.
  WholeBand belt_damping_by_places(const NodeValues& q, const NodeValues& v, const RimFrame& rim);
  /// The step is done at q.
  void commit(const NodeValues& q, const RimFrame& rim, const StepRule& rule);

 private:
  void place(const NodeValues& q, const RimFrame& rim);

  BeltForces belt_;
  SidewallForces sidewall_;
  RimRows nodes_, node_rates_, knots_, knot_rates_;
  RimRows of_belt_, of_sidewall_;  // forces
  StiffnessRows stiffness_;
};

}  // namespace latsch::ring_tire
