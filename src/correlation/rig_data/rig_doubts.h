// SPDX-License-Identifier: Apache-2.0
// Doubts about the recordings of a drum rig and their processing, after the processing.
#pragma once

#include <string>
#include <vector>

#include "correlation/rig_data/rig_processing.h"

namespace latsch::correlation {

/// Returns one sentence for each doubt: the period does not fit the circumference, a passage
/// contains several hits, most passages were left out, samples are too far apart for a cleat, the
/// spectrum is requested at frequencies that were not recorded, and the force is negative or too
/// small for a wheel.
std::vector<std::string> doubts_of(const RigFile& rig, const RigResults& results);

}  // namespace latsch::correlation
