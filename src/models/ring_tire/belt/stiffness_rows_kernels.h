// SPDX-License-Identifier: Apache-2.0
// Conversion of rows in the rim's axes to blocks in inertial axes (stiffness_rows.h).
#include "models/ring_tire/belt/cyclic_band.h"
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Computes blocks = same + axes B axes^T, eight nodes at a time. `axes` holds X, a, Z one after
/// the other. Blocks are columns of four, `apart` from node to node.
void turn_blocks(int nodes,
                 const double* const rows[16],
                 const double* axes,
                 const double* same,
                 double* blocks,
                 int apart) {
  by_eight(0, nodes, [&](int k) {
    const auto B = [&](int r, int c) { return lanes(rows[4 * r + c] + k); };
    double* const to = blocks + k * apart;
    const auto put = [&](const Lanes& value, int place) {
      double values[8];
      store(value + all(same[place]), values);
      for (int i = 0; i < 8; ++i) to[i * apart + place] = values[i];
    };
    for (int c = 0; c < 3; ++c) {
      Lanes half[4];  // a column of B axes^T
      for (int i = 0; i < 4; ++i)
        half[i] = B(i, 0) * axes[c] + B(i, 1) * axes[3 + c] + B(i, 2) * axes[6 + c];
      for (int r = 0; r < 3; ++r)
        put(axes[r] * half[0] + axes[3 + r] * half[1] + axes[6 + r] * half[2], 4 * c + r);
      put(half[3], 4 * c + 3);
    }
    for (int r = 0; r < 3; ++r)
      put(axes[r] * B(0, 3) + axes[3 + r] * B(1, 3) + axes[6 + r] * B(2, 3), 12 + r);
    put(B(3, 3), 15);
  });
}

/// Computes rows of panels, eight nodes at a time: (same + B)^T. `same` has columns of four.
void fill_panels(int nodes, const double* const rows[16], const double* same, double* panels) {
  by_eight(0, nodes, [&](int k) {
    double* const to = panels + k * BandPanel::kSize;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) {
        double values[8];
        store(lanes(rows[4 * r + c] + k) + all(same[4 * c + r]), values);
        for (int i = 0; i < 8; ++i) to[i * BandPanel::kSize + BandPanel::kRows * r + c] = values[i];
      }
  });
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
