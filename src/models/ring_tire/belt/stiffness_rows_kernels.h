// SPDX-License-Identifier: Apache-2.0
// From rows in the rim's axes to blocks in inertial ones (stiffness_rows.h).
#include "numerics/kernels/kernel_loops.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// blocks = same + axes B axes^T, of eight nodes at a time. `axes`: X, a, Z one after the other.
/// Blocks are columns of four, `apart` from node to node.
void turn_blocks(int nodes,
                 const double* const rows[10],
                 const double* axes,
                 const double* same,
                 double* blocks,
                 int apart) {
  by_eight(0, nodes, [&](int k) {
    const Lanes xx = lanes(rows[0] + k), xy = lanes(rows[1] + k), xz = lanes(rows[2] + k),
                yy = lanes(rows[3] + k), yz = lanes(rows[4] + k), zx = lanes(rows[5] + k),
                zz = lanes(rows[6] + k);
    const Lanes y_psi = lanes(rows[7] + k), psi_y = lanes(rows[8] + k), psi_psi = lanes(rows[9] + k);
    const Lanes B[3][3] = {{xx, xy, xz}, {xy, yy, yz}, {zx, yz, zz}};
    double* const to = blocks + k * apart;
    const auto put = [&](const Lanes& value, int place) {
      double values[8];
      store(value + all(same[place]), values);
      for (int i = 0; i < 8; ++i) to[i * apart + place] = values[i];
    };
    for (int c = 0; c < 3; ++c) {
      Lanes half[3];  // a column of B axes^T
      for (int i = 0; i < 3; ++i)
        half[i] = B[i][0] * axes[c] + B[i][1] * axes[3 + c] + B[i][2] * axes[6 + c];
      for (int r = 0; r < 3; ++r)
        put(axes[r] * half[0] + axes[3 + r] * half[1] + axes[6 + r] * half[2], 4 * c + r);
      put(psi_y * axes[3 + c], 4 * c + 3);
      put(y_psi * axes[3 + c], 12 + c);
    }
    put(psi_psi, 15);
  });
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
