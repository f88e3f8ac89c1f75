// SPDX-License-Identifier: Apache-2.0
// Checks combinations of statements of an OpenCRG header [ASAM OpenCRG 1.2.0, 3.4.2 and 3.4.5].
#pragma once

#include "formats/road/open_crg_header.h"

namespace latsch::formats {

/// Brings modifiers into the form that the grid reads: factors of 0 on heights, slope and banking
/// are ignored, as the standard requires; offsets of the reference point are added to its position.
/// Reports these changes. Throws InputError for two positions of the reference point; adds a
/// warning for modifiers that others disable.
void settle_open_crg_modifiers(OpenCrgHeader& header);

/// The end of the reference line according to its channels phi, slope and banking in the last
/// record; NaN for a channel that is missing. The function warns if the header states another end.
struct OpenCrgEnd {
  double phi, slope, banking;
};
void compare_open_crg_end(OpenCrgHeader& header, const OpenCrgEnd& last);

}  // namespace latsch::formats
