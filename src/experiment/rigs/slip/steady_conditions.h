// SPDX-License-Identifier: Apache-2.0
// Conditions of a table of states beside the states themselves.
#pragma once

#include <optional>

#include "models/magic_formula/conventions.h"

namespace latsch::experiment {

struct SteadyConditions {
  magic_formula::Conventions conventions = {};
  /// Friction with the ground, for a specimen that takes it from a test; none: the specimen's own.
  std::optional<double> friction = {};
};

/// Conditions of a record of slips beside the record itself.
struct SlipHistoryConditions {
  /// Friction with the ground, for a specimen that takes it from a test; none: the specimen's own.
  std::optional<double> friction = {};
  /// Longest step of time, s, for a specimen that rolls in steps; none: the specimen's own.
  std::optional<double> step = {};
};

}  // namespace latsch::experiment
