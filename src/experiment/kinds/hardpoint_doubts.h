// SPDX-License-Identifier: Apache-2.0
// Finds hardpoints that are implausible for a suspension, although the suspension can be computed
// with them.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"

namespace latsch::experiment {

/// Returns a sentence for every implausible hardpoint of a suspension: a wheel of a radius that no
/// wheel has, or too far from the middle of the car; exchanged ball joints, exchanged ends of a
/// link, a contact point far beside its wheel, an end of a link far from its wheel, below the
/// ground, or on the other side of the car.
std::vector<std::string> doubts_about_hardpoints(const Node& root);

}  // namespace latsch::experiment
