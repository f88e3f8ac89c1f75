// SPDX-License-Identifier: Apache-2.0
// Specimens as the models of which exported units and cars are made: both know no specimen.
#pragma once

#include <memory>

#include "experiment/language/known_limits.h"
#include "experiment/language/specimen.h"
#include "models/car/drives.h"
#include "models/tire/rolls.h"

namespace latsch::experiment {

/// Returns the specimen as a model that rolls, which keeps the specimen; `rolls` is null if it does
/// not roll.
inline RollingModel rolling_model(const std::shared_ptr<Specimen>& specimen) {
  return {{specimen, specimen->find<Rolls>()}, {specimen, specimen->find<KnowsLimits>()}};
}

/// Returns the specimen as a model that drives, which keeps the specimen; `drives` is null if it
/// cannot be driven.
inline DrivingModel driving_model(const std::shared_ptr<Specimen>& specimen) {
  return {{specimen, specimen->find<Drives>()}, {specimen, specimen->find<KnowsLimits>()}};
}

}  // namespace latsch::experiment
