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
  /// m, along the spin axis, by which the nodes stand off the plane of the rim at rest: lateral
  /// run-out, from where belt and sidewall count; empty: none.
  const std::vector<double>& lateral_rest() const { return lateral_rest_; }
  /// q less that.
  NodeValues from_rest(const NodeValues& q, const RimFrame& rim) const;
  /// How the forces on the rim change with the nodes, and those on the nodes with the rim, both
  /// against the same fields of motion: rim and nodes turned about the spin axis, or moved along a
  /// unit vector of the rim's axes X, a, Z. By nodes, in these axes; of the last find_force and
  /// find_stiffness, of the same place. The belt's own forces turn and move along: the sidewall's
  /// count alone.
  void find_turned_rim(double scale, RimRows& row);
  void find_moved_rim(const Eigen::Vector3d& along, double scale, RimRows& row);
  /// The step is done at q.
  void commit(const NodeValues& q, const RimFrame& rim, const StepRule& rule);

 private:
  void place_nodes(const NodeValues& q, const RimFrame& rim);
  void place_knots();
  void place(const NodeValues& q, const RimFrame& rim) {
    place_nodes(q, rim);
    place_knots();
  }
  void spread(RimRows& row);

  std::vector<double> lateral_rest_;
  BeltForces belt_;
  SidewallForces sidewall_;
  RimRows nodes_, node_rates_, knots_, knot_rates_;
  RimRows of_belt_, of_sidewall_;  // forces
  RimRows at_knots_;               // of a row of the rim
  StiffnessRows stiffness_;
};

}  // namespace latsch::ring_tire
