// SPDX-License-Identifier: Apache-2.0
// Builds the road surface from header and records of an OpenCRG file: reference line, modifiers,
// options.
#pragma once

#include "formats/road/open_crg_header.h"
#include "formats/road/open_crg_records.h"
#include "models/road/crg_road.h"

namespace latsch::formats {

/// Returns the number of records that begin, end and increment of u in the header require; nullopt
/// if they are not all stated.
std::optional<long> expected_open_crg_rows(const OpenCrgHeader& header);

/// Sets `gaps` to the number of missing heights.
road::CrgGrid open_crg_grid(const OpenCrgHeader& header, const OpenCrgRecords& records, int& gaps);

}  // namespace latsch::formats
