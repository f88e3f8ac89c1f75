// SPDX-License-Identifier: Apache-2.0
// Finds numbers of a car that are implausible beside each other, although each may be that of some
// car and the car can be computed with them.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"

namespace latsch::experiment {

/// Returns a sentence for each of these: a center of mass at no height of a car or not between its
/// axles, a wheel whose moment of inertia does not fit its mass and radius, a damper of which a
/// speed seems to have another unit, a floor outside of the heights of the aerodynamic map.
/// `written` is the car's file, `whole` the car with its suspensions.
std::vector<std::string> doubts_about_car(const Document& written, const Document& whole);

}  // namespace latsch::experiment
