// SPDX-License-Identifier: Apache-2.0
// Keeps parts of a .tir that have no effect in Latsch but that other programs read: keys that are
// unknown or not used, and tables such as [SHAPE]. A new file of the same tire contains them again.
#pragma once

#include <string>

#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Returns `text`, a new file in SI, with these parts of the old file in their sections; a section
/// that the new file lacks is added at its end. If the old file is not in SI, its numbers would be
/// wrong in the new file: its parts except [SHAPE], which has no units, then become comments that
/// state their units.
std::string with_kept_parts(const std::string& text, const TirFile& tir);

}  // namespace latsch::formats
