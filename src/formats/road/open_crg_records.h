// SPDX-License-Identifier: Apache-2.0
// The records of an OpenCRG file: one row of numbers for every step along the reference line.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "formats/road/open_crg_header.h"

namespace latsch::formats {

struct OpenCrgRecords {
  int rows = 0;
  std::size_t columns = 0;     // as the header's channels
  std::vector<double> values;  // row by row; missing ones are NaN

  double at(int row, std::size_t column) const { return values[row * columns + column]; }
};

/// `rows`: as many are expected, where the header says so. Numbers stand in columns of 10 or 20 and
/// may touch; `*missing*`, `**unused**` and blanks are NaN.
OpenCrgRecords read_open_crg_records(std::string_view bytes,
                                     const OpenCrgHeader& header,
                                     std::optional<long> rows);

}  // namespace latsch::formats
