// SPDX-License-Identifier: Apache-2.0
// A double wishbone and its static values as printed by Lotus Suspension Analysis (README.md).
#pragma once

#include <string>
#include <vector>

#include "models/suspension/corner_geometry.h"

namespace latsch::verification {

/// The right wheel, ISO 8855.
suspension::CornerGeometry lotus_corner();

struct PrintedValue {
  std::string output;       // name in kinematic_outputs()
  double value, tolerance;  // SI
};
std::vector<PrintedValue> lotus_printed_values();

}  // namespace latsch::verification
