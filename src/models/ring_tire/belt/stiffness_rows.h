// SPDX-License-Identifier: Apache-2.0
// The places' part of a CyclicBand in the rim's axes, one row an entry of the blocks (k, k + j), so
// that it is summed for several nodes at once. Across the plane of the rim it is symmetric block by
// block: a string and a spring are, and bending stays in the plane.
#pragma once

#include <vector>

#include "models/ring_tire/belt/cyclic_band.h"
#include "models/ring_tire/belt/rim_frame.h"

namespace latsch::ring_tire {

class StiffnessRows {
 public:
  enum Entry { kXX, kXY, kXZ, kYY, kYZ, kZX, kZZ, kEntries };

  /// All zero, with `more` rows of the same length for a loop's own use.
  explicit StiffnessRows(int nodes, int more = 0);

  /// Entry of the blocks (k, k + j), j = 0 .. CyclicBand::kReach; block k at [k].
  double* row(int j, Entry entry) { return more(j * kEntries + entry - kOwn); }
  /// A loop's own row; [k] from k = -kBeyond to nodes + kBeyond - 1.
  double* more(int i) {
    return memory_.data() + (kOwn + i) * (nodes_ + 2 * kBeyond) + kBeyond;
  }
  /// K += these, turned into inertial axes.
  void add_to(CyclicBand& K, const RimFrame& rim);

 private:
  static constexpr int kOwn = (CyclicBand::kReach + 1) * kEntries;
  static constexpr int kBeyond = 3;  // as in rim_rows.h

  int nodes_;
  std::vector<double> memory_;
};

}  // namespace latsch::ring_tire
