// SPDX-License-Identifier: Apache-2.0
// Writes the results of `latsch process` as one HTML page that opens without a network: speeds and
// plateaus, averages with their spread, spectra, the rig's response, the table of the cases, and
// the true response beside it if it is known.
#pragma once

#include <string>

#include "correlation/rig_data/rig_processing.h"

namespace latsch::correlation {

std::string rig_page(const RigFile& rig, const RigResults& results);

}  // namespace latsch::correlation
