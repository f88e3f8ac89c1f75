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
  std::size_t columns = 0;     // number of the header's channels
  std::vector<double> values;  // row by row; a missing value is NaN

  double at(int row, std::size_t column) const { return values[row * columns + column]; }
};

/// Reads the records. `rows` is the expected number of rows, if the header states it. Numbers have
/// columns of 10 or 20 characters and need no blanks between them; `*missing*`, `**unused**` and
/// blanks are NaN.
OpenCrgRecords read_open_crg_records(std::string_view bytes,
                                     const OpenCrgHeader& header,
                                     std::optional<long> rows);

}  // namespace latsch::formats
