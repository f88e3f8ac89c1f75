// SPDX-License-Identifier: Apache-2.0
// Makes the surface from header and records of an OpenCRG file: reference line, modifiers, options.
#pragma once

#include "formats/road/open_crg_header.h"
#include "formats/road/open_crg_records.h"
#include "models/road/crg_road.h"

namespace latsch::formats {

/// Number of records that u in the header requires, if begin, end and increment are stated.
std::optional<long> expected_open_crg_rows(const OpenCrgHeader& header);

/// `gaps` becomes the number of missing heights.
road::CrgGrid open_crg_grid(const OpenCrgHeader& header, const OpenCrgRecords& records, int& gaps);

}  // namespace latsch::formats
