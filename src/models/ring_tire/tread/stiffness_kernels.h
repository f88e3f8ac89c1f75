// SPDX-License-Identifier: Apache-2.0
// What a station's stiffness is to the four nodes of its segment (tread_stiffness.cpp).
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::ring_tire::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// B += x X + y Y + z Z + u U.
LATSCH_INLINE void add_scaled(double* B,
                              const double* X,
                              double x,
                              const double* Y,
                              double y,
                              const double* Z,
                              double z,
                              const double* U,
                              double u) {
  for (int c = 0; c < 16; c += 8)
    store(lanes(B + c) + lanes(X + c) * x + lanes(Y + c) * y + lanes(Z + c) * z + lanes(U + c) * u,
          B + c);
}

/// The ten pairs of the four nodes, pair (m, m') at 4 m + m'.
void add_pairs(const StationStiffness& M,
               const double* w,
               const double* d,
               Eigen::Matrix4d* pairs) {
  const Eigen::Matrix4d dw = M.wd.transpose();
  for (int m = 0; m < 4; ++m)
    for (int o = m; o < 4; ++o)
      add_scaled(pairs[4 * m + o].data(),
                 M.ww.data(),
                 w[m] * w[o],
                 M.wd.data(),
                 w[m] * d[o],
                 dw.data(),
                 d[m] * w[o],
                 M.dd.data(),
                 d[m] * d[o]);
}

}  // namespace latsch::ring_tire::LATSCH_KERNELS
