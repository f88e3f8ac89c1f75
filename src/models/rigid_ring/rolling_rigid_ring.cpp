// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/rolling_rigid_ring.h"

#include "base/error.h"
#include "models/rigid_ring/rigid_ring_tire.h"

namespace latsch::rigid_ring {

std::unique_ptr<Tire> RollingRigidRing::tire(const Inflation& pressure) const {
  auto tire = RigidRingTire::make(formula_.parameters(), formula_.settings_at(pressure));
  if (!tire)
    throw InputError({formula_.file(), 0}, "makes no rigid ring: " + tire.failure().reason);
  return std::move(*tire);
}

}  // namespace latsch::rigid_ring
