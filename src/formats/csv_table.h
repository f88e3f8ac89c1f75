// SPDX-License-Identifier: Apache-2.0
// Tables as laboratories and spreadsheets write them, with units.
//
//   # anything
//   deflection [mm], force [N], type            deflection; force          (a decimal comma with
//   5.0,             812,       "lateral, 1"    mm;         kN              semicolons or tabs)
//                                               5,0;        0,812
//
// The unit of a column stands in brackets behind its name or in a second row that holds units
// alone. Columns without one are plain numbers or texts. Empty lines and lines that begin with #
// are skipped; CRLF, a byte order mark and quoted fields, also with line ends in them, are
// understood [RFC 4180].
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "formats/csv_fields.h"
#include "measurement/channels.h"

namespace latsch::formats {

class CsvTable {
 public:
  /// Throws InputError naming file and line: ragged rows, no header, a name that comes twice, a
  /// quote that is not closed, more than 16 MB or 1,000,000 cells.
  static CsvTable read(const std::filesystem::path& file);
  static CsvTable parse(std::string text, std::string file_name);

  const std::string& file() const { return file_; }
  int rows() const { return static_cast<int>(lines_.size()); }
  bool has(std::string_view column) const;
  /// Whether the table names the unit of that column.
  bool has_unit(std::string_view column) const;
  /// Names in the order of the file.
  std::vector<std::string> columns() const;
  Place place(int row) const { return {file_, lines_[row]}; }
  Place header_place() const { return {file_, header_line_}; }

  /// A column in the SI unit of `unit`. Throws InputError naming file and line for a missing
  /// column, a missing, unknown or wrong unit and for cells that are not finite numbers.
  std::vector<double> numbers(std::string_view column, std::string_view unit) const;
  /// The same; a column that names no unit is in SI.
  std::vector<double> si_numbers(std::string_view column, std::string_view unit) const;
  /// Integers without unit.
  std::vector<int> integers(std::string_view column) const;
  std::vector<std::string> texts(std::string_view column) const;
  std::string text(std::string_view column, int row) const;

  /// Every column, each in the SI unit of its dimension; all must be numbers.
  Channels channels() const;

  /// Throws for a column that is not among the `known`.
  void expect_only(const std::vector<std::string>& known) const;

 private:
  struct Column {
    std::string name;
    std::string unit;  // empty: none is given
  };

  int index(std::string_view column) const;
  std::string_view cell(int column, int row) const;
  double number(int column, int row, const Unit& unit) const;
  void read_header(const CsvFields::Row& row);
  bool take_units(const CsvFields::Row& row);

  std::string file_;
  std::shared_ptr<const CsvFields::Source> source_;  // what cells_ points into
  bool decimal_comma_ = false;
  int header_line_ = 0;
  std::vector<Column> columns_;
  std::vector<int> lines_;               // of each row of data
  std::vector<std::string_view> cells_;  // row by row
};

/// A table of channels of equal length, "name [unit]", one line a sample. `units` names the unit of
/// each column; empty: SI. Reading it gives the same bits back.
std::string csv_text(const Channels& channels, const std::vector<std::string>& units = {});

/// A name or text as a field of a comma-separated line: in quotes where it needs them.
std::string csv_field(std::string_view text);

}  // namespace latsch::formats
