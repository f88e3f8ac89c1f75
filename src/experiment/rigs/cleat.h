// SPDX-License-Identifier: Apache-2.0
// A bar that a tire rolls over or stands on. The keys are in experiment/tests/keys/cleat_keys.cpp.
#pragma once

#include <optional>

#include "base/document.h"

namespace latsch::experiment {

struct Cleat {
  double height = 0.0, length = 0.0, bevel = 0.0;  // m
  double angle = 0.0;                              // rad
};

/// Returns nothing if the test has no cleat; `widest` is the largest angle, rad. Throws InputError.
std::optional<Cleat> read_cleat(const Node& test, double widest);

}  // namespace latsch::experiment
