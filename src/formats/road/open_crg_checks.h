// SPDX-License-Identifier: Apache-2.0
// What the statements of an OpenCRG header say together [ASAM OpenCRG 1.2.0, 3.4.2 and 3.4.5].
#pragma once

#include "formats/road/open_crg_header.h"

namespace latsch::formats {

/// Brings modifiers into the form the grid takes and says what was done: factors of 0 on heights,
/// slope and banking are ignored, as the standard says; offsets of the reference point are added to
/// its place. InputError for two places of the reference point, with a warning for modifiers that
/// others make idle.
void settle_open_crg_modifiers(OpenCrgHeader& header);

/// Warns where the header's end of the reference line is another than that of its channels.
/// `last`: of channels phi, slope, banking in the last record; NaN where there is none.
struct OpenCrgEnd {
  double phi, slope, banking;
};
void compare_open_crg_end(OpenCrgHeader& header, const OpenCrgEnd& last);

}  // namespace latsch::formats
