// SPDX-License-Identifier: Apache-2.0
// Columns of a laboratory's file on their way to channels in SI, the last step of every reader of
// lab_table.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/tables/lab_table.h"

namespace latsch::formats {

/// A column of a laboratory's file.
struct LabColumn {
  TableColumn source;
  std::vector<double> values = {};  // NaN: a gap
  bool is_si = false;               // false: in the unit of `source`
  std::string fault = {};           // error in the cells, in words
};

/// Adds columns to the table, converted to SI; for columns without unit, uses the units that the
/// caller states. Throws InputError as read_lab_table() does.
void add_columns(std::vector<LabColumn> columns,
                 const std::map<std::string, std::string>& units,
                 const ExpectedUnit& expected,
                 const Place& header,
                 LabTable& table);

}  // namespace latsch::formats
