// SPDX-License-Identifier: Apache-2.0
// Finds statements of an OpenCRG header that contradict each other or the data [ASAM OpenCRG 1.2.0,
// 3.4.2]. Several statements of block $ROAD_CRG repeat what channels, positions of sections or
// other statements say. One of them is used, and the others are compared with it.
#pragma once

#include "formats/road/open_crg_header.h"
#include "formats/road/open_crg_records.h"
#include "models/road/crg_road.h"

namespace latsch::formats {

/// Adds a warning to the header for each contradicting statement, with the value that is used.
/// `grid` is the road of the header without the modifiers, which move and scale the road.
void warn_of_contradictions(OpenCrgHeader& header,
                            const OpenCrgRecords& records,
                            const road::CrgGrid& grid);

}  // namespace latsch::formats
