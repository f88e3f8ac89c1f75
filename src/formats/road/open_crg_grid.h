// SPDX-License-Identifier: Apache-2.0
// From header and records of an OpenCRG file to the surface: reference line, modifiers, options.
#pragma once

#include "formats/road/open_crg_header.h"
#include "formats/road/open_crg_records.h"
#include "models/road/crg_road.h"

namespace latsch::formats {

/// Records the header's u call for, where it names begin, end and increment.
std::optional<long> expected_open_crg_rows(const OpenCrgHeader& header);

/// `gaps`: heights that were missing.
road::CrgGrid open_crg_grid(const OpenCrgHeader& header, const OpenCrgRecords& records, int& gaps);

}  // namespace latsch::formats
