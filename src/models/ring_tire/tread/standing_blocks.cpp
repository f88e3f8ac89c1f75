// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/block_forces.h"

#define LATSCH_KERNELS_IN "models/ring_tire/tread/standing_block_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

void standing_forces(const BlockStep& step, const BlockGround& ground) {
  LATSCH_KERNEL(standing_forces)(step, ground);
}

void hold_friction(const BlockSpan& at,
                   int lines,
                   const BlockGround& ground,
                   const BlockLaw& law,
                   const double* Fn) {
  LATSCH_KERNEL(hold_friction)(at, lines, ground, law, Fn);
}

}  // namespace latsch::ring_tire
