// SPDX-License-Identifier: Apache-2.0
// Parts of a .tir that have no effect here but that other programs read: keys that are unknown or
// not used, and tables such as [SHAPE]. A new file of the same tire keeps them.
#pragma once

#include <string>

#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Returns the text of a new file, which is in SI, with these parts of the old one in their
/// sections; a section that the new file lacks is added at its end. If the old file is not in SI,
/// its numbers would have other units there: its parts but [SHAPE], which has none, then become
/// comments that state their units.
std::string with_kept_parts(const std::string& text, const TirFile& tir);

}  // namespace latsch::formats
