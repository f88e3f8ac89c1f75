// SPDX-License-Identifier: Apache-2.0
#include "numerics/kernels/kernel_lanes.h"

namespace latsch::benchmarks::LATSCH_KERNELS {

using namespace latsch::LATSCH_KERNELS;

/// Computes `count` times 64 fused multiply-adds in eight independent chains, which keeps both
/// arithmetic units of a core busy.
double multiply_add(int count, double by) {
  Lanes x[8];
  for (int i = 0; i < 8; ++i) x[i] = 1.0 + i;
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < 8; ++i) x[i] = x[i] * by + 1e-9;
  for (int i = 1; i < 8; ++i) x[0] += x[i];
  return sum(x[0]);
}

}  // namespace latsch::benchmarks::LATSCH_KERNELS
