// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/inner_forces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace latsch::ring_tire {

namespace {

/// Returns the lateral run-out of every node such that the belt's curve, a spline with the nodes
/// as control points, has the given run-out at its knots.
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
      at_knots_(parameters.nodes),
      stiffness_(parameters.nodes) {}

void InnerForces::place_nodes(const NodeValues& q, const RimFrame& rim) { nodes_.place(q, rim); }

/// Subtracts the lateral rest positions and computes the knots.
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

/// If the rim rotates by a small angle, its knots move by this angle times (z, 0, -x), and the
/// forces at the knots rotate by the angle.
void InnerForces::find_turned_rim(double scale, RimRows& row) {
  const double *x = knots_.row(RimRows::kX), *z = knots_.row(RimRows::kZ);
  const double *fx = of_sidewall_.row(RimRows::kX), *fz = of_sidewall_.row(RimRows::kZ);
  const auto slope = [&](int i) { return stiffness_.scratch(SidewallForces::kKnotSlopes + i); };
  const double *xx = slope(0), *xz = slope(1), *zz = slope(2);
  double *to_x = at_knots_.row(RimRows::kX), *to_z = at_knots_.row(RimRows::kZ);
  for (int k = 0; k < at_knots_.nodes(); ++k) {
    to_x[k] = (xx[k] * z[k] - xz[k] * x[k]) / scale + fz[k];
    to_z[k] = (xz[k] * z[k] - zz[k] * x[k]) / scale - fx[k];
    at_knots_.row(RimRows::kY)[k] = at_knots_.row(RimRows::kTorsion)[k] = 0.0;
  }
  spread(row);
}

void InnerForces::find_moved_rim(const Eigen::Vector3d& along, double scale, RimRows& row) {
  const auto slope = [&](int i) { return stiffness_.scratch(SidewallForces::kKnotSlopes + i); };
  const double *xx = slope(0), *xz = slope(1), *zz = slope(2), *yy = slope(3);
  const double twist = sidewall_.torsion_by_lateral(), torsion = sidewall_.torsion();
  for (int k = 0; k < at_knots_.nodes(); ++k) {
    at_knots_.row(RimRows::kX)[k] = (xx[k] * along[0] + xz[k] * along[2]) / scale;
    at_knots_.row(RimRows::kY)[k] = (yy[k] / scale + torsion * twist * twist) * along[1];
    at_knots_.row(RimRows::kZ)[k] = (xz[k] * along[0] + zz[k] * along[2]) / scale;
    at_knots_.row(RimRows::kTorsion)[k] = -torsion * twist * along[1];
  }
  spread(row);
}

void InnerForces::spread(RimRows& row) {
  for (int i = 0; i < RimRows::kRows; ++i) std::fill_n(row.row(i), row.nodes(), 0.0);
  row.add_from_knots(at_knots_);
}

void InnerForces::commit(const NodeValues& q, const RimFrame& rim, const StepRule& rule) {
  place(q, rim);
  sidewall_.commit(knots_, rule);
}

}  // namespace latsch::ring_tire
