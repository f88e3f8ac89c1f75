// SPDX-License-Identifier: Apache-2.0
// The geometry of a double wishbone and its static values as Lotus Suspension Analysis prints them
// (README.md).
#pragma once

#include <string>
#include <vector>

#include "models/suspension/corner_geometry.h"

namespace latsch::verification {

/// Returns the corner of the right wheel, in axes of ISO 8855.
suspension::CornerGeometry lotus_corner();

struct PrintedValue {
  std::string output;       // name of the value in kinematic_outputs()
  double value, tolerance;  // SI
};
std::vector<PrintedValue> lotus_printed_values();

}  // namespace latsch::verification
