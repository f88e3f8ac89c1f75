// SPDX-License-Identifier: Apache-2.0
// Finds hardpoints that are implausible for a suspension, although the suspension can be computed
// with them.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"

namespace latsch::experiment {

/// Returns a sentence for every implausible hardpoint of a suspension: exchanged ball joints,
/// exchanged ends of a link, a contact point far beside its wheel, the outer end of a link far from
/// its wheel.
std::vector<std::string> doubts_about_hardpoints(const Node& root);

}  // namespace latsch::experiment
