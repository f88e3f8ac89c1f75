// SPDX-License-Identifier: Apache-2.0
// The nodes' values in the rim's axes X, a, Z from its center, one row a component, so that loops
// around the ring work on several nodes at once. Rows go on by kBeyond nodes at both ends: no loop
// has to close the ring.
#pragma once

#include <vector>

#include "models/ring_tire/belt/rim_frame.h"

namespace latsch::ring_tire {

class RimRows {
 public:
  static constexpr int kBeyond = 3;
  enum Row { kX, kY, kZ, kTorsion, kRows };

  /// With `more` rows for a loop's own use behind the four.
  explicit RimRows(int nodes, int more = 0);

  int nodes() const { return nodes_; }
  /// Row i; its node k = -kBeyond .. nodes + kBeyond - 1 stands at [k].
  double* row(int i) { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }
  const double* row(int i) const { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }
  /// Positions and torsions.
  void place(const NodeValues& q, const RimFrame& rim);
  /// Velocities against the rim's material, v - v_c - ω × (x - c), of nodes at their places `at`,
  /// and rates of torsion.
  void place_rates(const RimRows& at, const NodeValues& v, const RimFrame& rim);
  /// y of each node less this.
  void count_from(const std::vector<double>& y);
  /// B x of belt_curve.h.
  void place_knots(const RimRows& nodes);
  /// += B' f, f at the knots.
  void add_from_knots(RimRows& knots);
  /// Turned back: forces in inertial axes.
  void turn_back(const RimFrame& rim, NodeValues& force) const;

 private:
  void close();

  int nodes_;
  std::vector<double> memory_;
};

}  // namespace latsch::ring_tire
