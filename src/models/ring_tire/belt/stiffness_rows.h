// SPDX-License-Identifier: Apache-2.0
// A CyclicBand under construction, in the rim's axes. Entries of the blocks (k, k + j) that differ
// from node to node are stored in rows, so they are summed for several nodes at once; blocks that
// are the same at every node are stored once.
#pragma once

#include <array>
#include <vector>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"

namespace latsch::ring_tire {

class StiffnessRows {
 public:
  /// Entries of a block, row by row: x, y (lateral), z, torsion.
  enum Entry { kXX = 0, kXZ = 2, kYY = 5, kZX = 8, kZZ = 10, kEntries = 16 };
  static constexpr int kScratch = 44;

  explicit StiffnessRows(int nodes);

  /// Sets the blocks that are the same at every node to zero.
  void start();
  /// Entry 4 row + column of the blocks (k, k + j), j = 0 .. CyclicBand::kReach; block k is at [k].
  double* row(int j, int entry) { return at(j * kEntries + entry); }
  /// Work memory of loops: [k] from k = -kBeyond to nodes + kBeyond - 1.
  double* scratch(int i) { return at(kOwn + i); }
  /// The part common to all blocks (k, k + j).
  Eigen::Matrix4d& same(int j) { return same_[static_cast<std::size_t>(j)]; }
  /// Adds a stiffness k at every knot: B' k B of belt_curve.h.
  void add_at_knots(const Eigen::Matrix4d& k);
  /// Writes the blocks, transposed, below the diagonals of panels.
  void fill_panels(double* panels) const;
  /// Sets K to these blocks in inertial axes.
  void turn_back(const RimFrame& rim, CyclicBand& K) const;

 private:
  static constexpr int kOwn = (CyclicBand::kReach + 1) * kEntries;
  static constexpr int kBeyond = 3;  // see rim_rows.h

  double* at(int i) { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }
  const double* at(int i) const { return memory_.data() + i * (nodes_ + 2 * kBeyond) + kBeyond; }

  int nodes_;
  std::vector<double> memory_;
  std::array<Eigen::Matrix4d, CyclicBand::kReach + 1> same_;
};

}  // namespace latsch::ring_tire
