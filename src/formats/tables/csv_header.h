// SPDX-License-Identifier: Apache-2.0
// The line of names of a separated-value file and the line of units below it, if there is one.
//
// A line below the names contains units if every cell of it is a unit, or if it has no number and
// the next line has numbers below its texts. In the second case a text that is no unit is an
// unknown unit, never a value.
#pragma once

#include <string>
#include <vector>

#include "formats/tables/table_column.h"
#include "formats/text/csv_fields.h"

namespace latsch::formats {

struct CsvHeader {
  int line = 0;
  std::vector<TableColumn> columns;
};

/// Reads names and units and leaves `fields` at the first row of values. Throws InputError for an
/// empty file, a column without a name, and a name that is a number or occurs twice.
CsvHeader read_csv_header(CsvFields& fields, const std::string& file);

/// Returns the error message for a row with another number of fields than the header.
std::string wrong_number_of_fields(std::size_t found, const CsvHeader& header, char separator);

}  // namespace latsch::formats
