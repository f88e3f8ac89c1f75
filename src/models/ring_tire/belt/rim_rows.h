// SPDX-License-Identifier: Apache-2.0
// The nodes' values in the rim's axes X, a, Z from its center, one row for each component, so that
// loops around the ring process several nodes at once. Rows continue by kBeyond nodes at both ends,
// so no loop has to close the ring.
#pragma once

#include <vector>

#include "models/ring_tire/belt/rim_frame.h"

namespace latsch::ring_tire {

class RimRows {
 public:
  static constexpr int kBeyond = 3;
  enum Row { kX, kY, kZ, kTorsion, kRows };

  /// Has `more` additional rows behind the four for a loop's own use.
  explicit RimRows(int nodes, int more = 0);

  int nodes() const { return nodes_; }
  /// Row i; the value of node k = -kBeyond .. nodes + kBeyond - 1 is at [k].
  double* row(int i) { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }
  const double* row(int i) const { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }
  /// Stores positions and torsions.
  void place(const NodeValues& q, const RimFrame& rim);
  /// Stores velocities relative to the rim's material, v - v_c - ω × (x - c), of nodes at the
  /// positions `at`, and rates of torsion.
  void place_rates(const RimRows& at, const NodeValues& v, const RimFrame& rim);
  /// Subtracts `y` from the y of each node.
  void count_from(const std::vector<double>& y);
  /// Stores B x of belt_curve.h.
  void place_knots(const RimRows& nodes);
  /// Adds B' f, where f are forces at the knots.
  void add_from_knots(RimRows& knots);
  /// Rotates forces back into inertial axes.
  void turn_back(const RimFrame& rim, NodeValues& force) const;

 private:
  void close();

  int nodes_;
  std::vector<double> memory_;
};

}  // namespace latsch::ring_tire
