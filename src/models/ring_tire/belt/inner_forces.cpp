// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/inner_forces.h"

namespace latsch::ring_tire {

InnerForces::InnerForces(const RingParameters& parameters)
    : belt_(parameters.belt, parameters.nodes),
      sidewall_(
          parameters.sidewall, parameters.belt.radius, parameters.nodes, parameters.belt.conicity),
      nodes_(parameters.nodes),
      node_rates_(parameters.nodes),
      knots_(parameters.nodes),
      knot_rates_(parameters.nodes),
      of_belt_(parameters.nodes, BeltForces::kScratch),
      of_sidewall_(parameters.nodes, SidewallForces::kScratch),
      stiffness_(parameters.nodes) {}

void InnerForces::place(const NodeValues& q, const RimFrame& rim) {
  nodes_.place(q, rim);
  knots_.place_knots(nodes_);
}

void InnerForces::find_force(const NodeValues& q,
                             const NodeValues& v,
                             const RimFrame& rim,
                             const StepRule& rule,
                             NodeValues& force) {
  place(q, rim);
  if (!rule.statics()) {
    node_rates_.place_rates(nodes_, v, rim);
    knot_rates_.place_knots(node_rates_);
  }
  belt_.find_force(nodes_, rule.statics() ? nullptr : &node_rates_, of_belt_);
  sidewall_.find_force(knots_, knot_rates_, rule, of_sidewall_);
  of_belt_.add_from_knots(of_sidewall_);
  of_belt_.turn_back(rim, force);
}

StiffnessRows& InnerForces::find_stiffness(const NodeValues& q,
                                           const RimFrame& rim,
                                           const StepRule& rule,
                                           double scale) {
  place(q, rim);
  belt_.find_stiffness(nodes_, rule.velocity, scale, stiffness_);
  sidewall_.add_stiffness(knots_, rule, scale, stiffness_);
  return stiffness_;
}

StiffnessRows& InnerForces::find_belt_damping(const NodeValues& q, const RimFrame& rim) {
  place(q, rim);
  belt_.find_damping(nodes_, 1.0, stiffness_);
  return stiffness_;
}

WholeBand InnerForces::belt_damping_by_places(const NodeValues& q,
                                              const NodeValues& v,
                                              const RimFrame& rim) {
  place(q, rim);
  node_rates_.place_rates(nodes_, v, rim);
  return damping_by_places(belt_, nodes_, node_rates_, rim);
}

void InnerForces::commit(const NodeValues& q, const RimFrame& rim, const StepRule& rule) {
  place(q, rim);
  sidewall_.commit(knots_, rule);
}

}  // namespace latsch::ring_tire
