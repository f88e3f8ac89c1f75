// SPDX-License-Identifier: Apache-2.0
// From rows in the rim's axes to blocks in inertial ones (stiffness_rows.h).
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// blocks += axes B axes^T of eight nodes at a time; `axes`: X, a, Z one after the other. Blocks
/// are columns of four, `apart` from one node to the next.
void add_turned(
    int nodes, const double* const rows[7], const double* axes, double* blocks, int apart) {
  for (int begin = 0; begin < nodes; begin += 8) {
    // The last eight may come twice in part: then only the new ones count.
    const int k = begin + 8 <= nodes ? begin : nodes - 8;
    const Lanes xx = lanes(rows[0] + k), xy = lanes(rows[1] + k), xz = lanes(rows[2] + k),
                yy = lanes(rows[3] + k), yz = lanes(rows[4] + k), zx = lanes(rows[5] + k),
                zz = lanes(rows[6] + k);
    const Lanes B[3][3] = {{xx, xy, xz}, {xy, yy, yz}, {zx, yz, zz}};
    Lanes half[3][3];  // B axes^T
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        half[i][c] = B[i][0] * axes[c] + B[i][1] * axes[3 + c] + B[i][2] * axes[6 + c];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        double turned[8];
        store(axes[r] * half[0][c] + axes[3 + r] * half[1][c] + axes[6 + r] * half[2][c], turned);
        for (int i = begin - k; i < 8; ++i) blocks[(k + i) * apart + 4 * c + r] += turned[i];
      }
  }
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
