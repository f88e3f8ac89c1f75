// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/inner_forces.h"

#include <cmath>
#include <numbers>

namespace latsch::ring_tire {

namespace {

/// Of the nodes, whose curve has the run-out at its knots.
std::vector<double> lateral_rest_of(const RingParameters& ring) {
  std::vector<double> rest;
  if (ring.uniformity.lateral_runout.empty()) return rest;
  std::vector<Harmonic> of_nodes = ring.uniformity.lateral_runout;
  const double segment = 2.0 * std::numbers::pi / ring.nodes;
  for (std::size_t i = 0; i < of_nodes.size(); ++i)
    of_nodes[i].amplitude *= 3.0 / (2.0 + std::cos((i + 1.0) * segment));
  for (int k = 0; k < ring.nodes; ++k) rest.push_back(runout_at(of_nodes, k * segment));
  return rest;
}

}  // namespace

InnerForces::InnerForces(const RingParameters& parameters)
    : lateral_rest_(lateral_rest_of(parameters)),
      belt_(parameters.belt, parameters.nodes),
      sidewall_(
          parameters.sidewall, parameters.belt.radius, parameters.nodes, parameters.belt.conicity),
      nodes_(parameters.nodes),
      node_rates_(parameters.nodes),
      knots_(parameters.nodes),
      knot_rates_(parameters.nodes),
      of_belt_(parameters.nodes, BeltForces::kScratch),
      of_sidewall_(parameters.nodes, SidewallForces::kScratch),
      stiffness_(parameters.nodes) {}

void InnerForces::place_nodes(const NodeValues& q, const RimFrame& rim) { nodes_.place(q, rim); }

/// From here on places across the rim count from those at rest.
void InnerForces::place_knots() {
  if (!lateral_rest_.empty()) nodes_.count_from(lateral_rest_);
  knots_.place_knots(nodes_);
}

NodeValues InnerForces::from_rest(const NodeValues& q, const RimFrame& rim) const {
  NodeValues from_rest = q;
  for (std::size_t k = 0; k < lateral_rest_.size(); ++k)
    from_rest.col(static_cast<Eigen::Index>(k)).head<3>() -= lateral_rest_[k] * rim.a;
  return from_rest;
}

void InnerForces::find_force(const NodeValues& q,
                             const NodeValues& v,
                             const RimFrame& rim,
                             const StepRule& rule,
                             NodeValues& force) {
  place_nodes(q, rim);
  if (!rule.statics()) {
    node_rates_.place_rates(nodes_, v, rim);
    knot_rates_.place_knots(node_rates_);
  }
  place_knots();
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
  place_nodes(q, rim);
  node_rates_.place_rates(nodes_, v, rim);
  place_knots();
  return damping_by_places(belt_, nodes_, node_rates_, rim);
}

void InnerForces::commit(const NodeValues& q, const RimFrame& rim, const StepRule& rule) {
  place(q, rim);
  sidewall_.commit(knots_, rule);
}

}  // namespace latsch::ring_tire
