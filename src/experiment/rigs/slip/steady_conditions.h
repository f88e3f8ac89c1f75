// SPDX-License-Identifier: Apache-2.0
// Conditions of a table of steady states beside the states themselves.
#pragma once

#include <optional>

#include "models/magic_formula/conventions.h"

namespace latsch::experiment {

struct SteadyConditions {
  magic_formula::Conventions conventions = {};
  /// Friction with the ground, for a specimen that takes it from a test; none: the specimen's own.
  std::optional<double> friction = {};
};

}  // namespace latsch::experiment
