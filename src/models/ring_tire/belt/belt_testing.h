// SPDX-License-Identifier: Apache-2.0
// For tests: forces and stiffness of belt and sidewall, each alone, in inertial axes.
#pragma once

#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/sidewall.h"

namespace latsch::ring_tire {

inline NodeValues force_of(const BeltForces& belt, const NodeValues& q, const RimFrame& rim) {
  const int nodes = static_cast<int>(q.cols());
  RimRows at(nodes), force(nodes, BeltForces::kScratch);
  at.place(q, rim);
  belt.find_force(at, nullptr, force);
  NodeValues turned(4, nodes);
  force.turn_back(rim, turned);
  return turned;
}

inline CyclicBand stiffness_of(const BeltForces& belt, const NodeValues& q, const RimFrame& rim) {
  const int nodes = static_cast<int>(q.cols());
  RimRows at(nodes);
  at.place(q, rim);
  StiffnessRows rows(nodes);
  belt.find_stiffness(at, 0.0, 1.0, rows);
  CyclicBand K(nodes);
  rows.turn_back(rim, K);
  return K;
}

/// Returns the forces on the knots, whose positions are `knots`, at rest.
inline NodeValues force_of(const SidewallForces& sidewall,
                           const NodeValues& knots,
                           const RimFrame& rim) {
  const int nodes = static_cast<int>(knots.cols());
  RimRows at(nodes), rate(nodes), force(nodes, SidewallForces::kScratch);
  at.place(knots, rim);
  sidewall.find_force(at, rate, {}, force);
  NodeValues turned(4, nodes);
  force.turn_back(rim, turned);
  return turned;
}

/// Returns the stiffness of the nodes.
inline CyclicBand stiffness_of(const SidewallForces& sidewall,
                               const NodeValues& knots,
                               const RimFrame& rim) {
  const int nodes = static_cast<int>(knots.cols());
  RimRows at(nodes);
  at.place(knots, rim);
  StiffnessRows rows(nodes);
  sidewall.add_stiffness(at, {}, 1.0, rows);
  CyclicBand K(nodes);
  rows.turn_back(rim, K);
  return K;
}

}  // namespace latsch::ring_tire
