// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/bushing_batch.h"

#include <cassert>
#include <cstddef>
#include <type_traits>

// The kernels read objects of these types as arrays of doubles, so the sizes must agree.
static_assert(sizeof(latsch::multibody::Pose) == 12 * sizeof(double));
static_assert(sizeof(latsch::multibody::BushingPlace) == 24 * sizeof(double));
static_assert(sizeof(latsch::multibody::BushingParameters) ==
              12 * sizeof(double) +
                  sizeof(std::vector<latsch::multibody::BushingParameters::Part>) +
                  sizeof(double));  // the flag `rigid` with its padding

#define LATSCH_KERNELS_IN "models/multibody/bushing_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::multibody {

double add_bushings(std::span<const BushingTask> tasks, bool moving, double rate_share) {
  assert(tasks.size() % 4 == 0);
  return LATSCH_KERNEL(add_bushings)(
      tasks.data(), static_cast<int>(tasks.size()), moving, rate_share);
}

}  // namespace latsch::multibody
