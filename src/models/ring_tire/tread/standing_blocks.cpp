// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/block_forces.h"

#define LATSCH_KERNELS_IN "models/ring_tire/tread/standing_block_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {

void standing_forces(const SegmentStations& at,
                     const BlockLines& lines,
                     const BlockGround& ground,
                     const BlockMemory& before,
                     const BlockLaw& law,
                     const BlockResults& results,
                     double* const force[4]) {
  LATSCH_KERNEL(standing_forces)(at, lines, ground, before, law, results, force);
}

void bent_standing_forces(const SegmentStations& at,
                          const BlockLines& lines,
                          const BlockGround& ground,
                          const BlockMemory& before,
                          const BlockLaw& law,
                          const BlockResults& results,
                          double* const force[4]) {
  LATSCH_KERNEL(bent_standing_forces)(at, lines, ground, before, law, results, force);
}

void hold_friction(const BlockSpan& at,
                   int lines,
                   const BlockGround& ground,
                   const BlockLaw& law,
                   const double* Fn) {
  LATSCH_KERNEL(hold_friction)(at, lines, ground, law, Fn);
}

}  // namespace latsch::ring_tire
