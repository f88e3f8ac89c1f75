// SPDX-License-Identifier: Apache-2.0
// Reads the output files of an outside program into channels, as a study declares them.
//
//   table     columns by the names in the header, which also states their units (csv_table.h)
//   columns   numbers in rows, columns by their number; lines before the first row of numbers are
//             a header
//   keys      lines `key = number` or `key: number`
//   pattern   every line that matches a regular expression (ECMAScript) is a sample; the groups in
//             brackets are its numbers
//   tydex     channels of a TYDEX file by their names, and constants, which have one value
//             (tydex_file.h); the file has their units
//
// If data are missing, are too few or hold numbers that are not finite, the result is a Failure
// with Cause::bad_output that names the output, the file, what was found and what was expected.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "measurement/channels.h"

namespace latsch {

struct OutputReader {
  enum class Kind { table, columns, keys, pattern, tydex };
  struct Quantity {
    std::string name;
    std::string unit = "1";  // unit of the quantity in the file
  };

  std::string name = {};  // name of the output; its channels are NAME/QUANTITY
  std::filesystem::path file = {};
  Kind kind = Kind::table;
  std::vector<Quantity> quantities = {};
  std::vector<int> columns = {};       // for `columns`: position of each quantity, counted from 1
  std::vector<std::string> keys = {};  // for `keys`: text before each number
  std::string pattern = {};            // for `pattern`: the regular expression
  /// For `pattern`: only lines after one that contains this text count.
  std::string after = {};
  int samples = 0;  // expected number of samples; 0: at least one
};

/// Reads the output files in `folder`. The channels are in SI units.
Result<std::vector<Channel>> read_output(const OutputReader& reader,
                                         const std::filesystem::path& folder);

}  // namespace latsch
