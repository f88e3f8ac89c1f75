// SPDX-License-Identifier: Apache-2.0
// A CyclicBand in the making, in the rim's axes: what differs from node to node by rows, one an
// entry of the blocks (k, k + j), so that it is summed for several nodes at once; what is the same
// at every node once.
#pragma once

#include <array>
#include <vector>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"

namespace latsch::ring_tire {

class StiffnessRows {
 public:
  /// Of a block, row by row: x, y across the plane of the rim, z, torsion.
  enum Entry { kXX = 0, kXZ = 2, kYY = 5, kZX = 8, kZZ = 10, kEntries = 16 };
  static constexpr int kScratch = 44;

  explicit StiffnessRows(int nodes);

  /// Nothing is the same at every node.
  void start();
  /// Entry 4 row + column of the blocks (k, k + j), j = 0 .. CyclicBand::kReach; block k at [k].
  double* row(int j, int entry) { return at(j * kEntries + entry); }
  /// For loops to work on: [k] from k = -kBeyond to nodes + kBeyond - 1.
  double* scratch(int i) { return at(kOwn + i); }
  /// Of all blocks (k, k + j).
  Eigen::Matrix4d& same(int j) { return same_[static_cast<std::size_t>(j)]; }
  /// What is k at every knot: B' k B of belt_curve.h.
  void add_at_knots(const Eigen::Matrix4d& k);
  /// The same blocks, transposed, below the diagonals of panels.
  void fill_panels(double* panels) const;
  /// K = these, turned into inertial axes.
  void turn_back(const RimFrame& rim, CyclicBand& K) const;

 private:
  static constexpr int kOwn = (CyclicBand::kReach + 1) * kEntries;
  static constexpr int kBeyond = 3;  // as in rim_rows.h

  double* at(int i) { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }
  const double* at(int i) const { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }

  int nodes_;
  std::vector<double> memory_;
  std::array<Eigen::Matrix4d, CyclicBand::kReach + 1> same_;
};

}  // namespace latsch::ring_tire
