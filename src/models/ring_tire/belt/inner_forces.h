// SPDX-License-Identifier: Apache-2.0
// Belt and sidewall together, with the work memory of their loops, which is kept from step to step.
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

  /// Computes the forces of both on the nodes at q with velocities v, in inertial axes.
  void find_force(const NodeValues& q,
                  const NodeValues& v,
                  const RimFrame& rim,
                  const StepRule& rule,
                  NodeValues& force);
  /// Returns minus the derivative of the forces by q, times scale; valid until the next call.
  StiffnessRows& find_stiffness(const NodeValues& q,
                                const RimFrame& rim,
                                const StepRule& rule,
                                double scale);
  /// Returns C of (30) at q; valid until the next call.
  StiffnessRows& find_belt_damping(const NodeValues& q, const RimFrame& rim);
  /// Returns D of (31) at q with velocities v.
  WholeBand belt_damping_by_places(const NodeValues& q, const NodeValues& v, const RimFrame& rim);
  /// Lateral run-out: distance of each node from the plane of the rim at rest along the spin axis,
  /// m. Belt and sidewall are measured from there. Empty: none.
  const std::vector<double>& lateral_rest() const { return lateral_rest_; }
  /// Returns q minus the lateral run-out.
  NodeValues from_rest(const NodeValues& q, const RimFrame& rim) const;
  /// Derivatives of the forces on the rim by the nodes, and of those on the nodes by the rim. Both
  /// are projected on the same motions: rim and nodes rotated about the spin axis, or moved along a
  /// unit vector of the rim's axes X, a, Z. The rows are by nodes, in these axes, and belong to the
  /// last find_force and find_stiffness at the same position. The belt's own forces rotate and move
  /// with it, so only the sidewall's count.
  void find_turned_rim(double scale, RimRows& row);
  void find_moved_rim(const Eigen::Vector3d& along, double scale, RimRows& row);
  /// Ends the step at q.
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
  RimRows at_knots_;               // used for a row of the rim
  StiffnessRows stiffness_;
};

}  // namespace latsch::ring_tire
