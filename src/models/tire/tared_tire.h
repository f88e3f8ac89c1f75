// SPDX-License-Identifier: Apache-2.0
// A tire on a rig whose load cell was tared with the wheel in the air. Its forces do not include
// the weight of the belt, which the hub carries in the air. The vertical force Fz on the hub at
// rest then equals the load on the road, for a tire without mass, a rigid ring with its belt's
// weight and a flexible ring alike.
//
// Only the vertical force is tared. The weight of an imbalance still causes a moment on the wheel.
#pragma once

#include <memory>

#include "models/tire/tire.h"

namespace latsch {

/// Returns the weight, N, that the hub of an upright wheel carries in the air; 0 for a tire without
/// mass or weight.
double weight_in_air(const Tire& tire);

/// Returns the tire with tared forces, or the tire itself if it has no weight.
std::unique_ptr<Tire> tared(std::unique_ptr<Tire> tire);

}  // namespace latsch
