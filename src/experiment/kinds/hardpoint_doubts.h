// SPDX-License-Identifier: Apache-2.0
// Finds hardpoints that hardly any suspension has, although they can be computed with.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"

namespace latsch::experiment {

/// Returns a sentence on every such hardpoint of a suspension: exchanged ball joints or ends of a
/// link, a contact point beside its wheel, the outer end of a link outside of the wheel.
std::vector<std::string> doubts_about_hardpoints(const Node& root);

}  // namespace latsch::experiment
