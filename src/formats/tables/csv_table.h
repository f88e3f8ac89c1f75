// SPDX-License-Identifier: Apache-2.0
// Tables of laboratories and spreadsheets, with units.
//
//   # anything
//   deflection [mm], force [N], type            deflection; force          (a decimal comma with
//   5.0,             812,       "lateral, 1"    mm;         kN              semicolons or tabs)
//                                               5,0;        0,812
//
// The unit of a column is in brackets behind its name (table_column.h) or in a second row
// (csv_header.h); base/unit_reading.h says which spellings are known. Columns without a unit are
// plain numbers or texts. Empty lines and lines that begin with # are skipped; CRLF, a byte order
// mark, Windows-1252 and quoted fields, also with line ends in them, are understood [RFC 4180].
//
// A file is mapped, not copied, and only the positions of some rows are stored: a table of 1 GB
// needs some megabytes besides the requested columns. Each call that returns columns reads the file
// once, so several columns should be requested in one call.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/units.h"
#include "formats/tables/table_column.h"
#include "formats/text/csv_fields.h"
#include "measurement/channels.h"

namespace latsch::formats {

class CsvTable {
 public:
  /// Throws InputError naming file and line: ragged rows, no header, a name that occurs twice, a
  /// quote that is not closed, more than 1 GiB or 2^31 lines.
  static CsvTable read(const std::filesystem::path& file);
  static CsvTable parse(std::string text, std::string file_name);
  static CsvTable parse(std::shared_ptr<const MappedFile> source, std::string file_name);

  const std::string& file() const { return file_; }
  int rows() const { return rows_; }
  bool has(std::string_view column) const;
  /// True if the table states a unit for the column.
  bool has_unit(std::string_view column) const;
  /// Returns the unit of a column as written; "" if the table states none.
  const std::string& unit(std::string_view column) const;
  /// Returns every column as the header states it.
  const std::vector<TableColumn>& header() const { return columns_; }
  /// Returns the names of the columns in the order of the file. All functions also find a column by
  /// its whole title, "force [N]".
  std::vector<std::string> columns() const;
  Place place(int row) const;
  Place header_place() const { return {file_, header_line_}; }

  /// Returns a column in the SI unit of `unit`. Throws InputError naming file and line for a
  /// missing column, a missing, unknown or wrong unit and for cells that are not finite numbers.
  std::vector<double> numbers(std::string_view column, std::string_view unit) const;
  /// A column and the unit in which it is requested.
  struct Wanted {
    std::string column, unit;
  };
  std::vector<std::vector<double>> numbers(const std::vector<Wanted>& columns) const;
  /// Calls the function with blocks of `rows` rows of the columns, the last one shorter; for tables
  /// too long to be kept in memory.
  void for_blocks(const std::vector<Wanted>& columns,
                  int rows,
                  const std::function<void(std::vector<std::vector<double>>&)>& block) const;
  /// Columns in which a cell that is no finite number is a gap, NaN.
  struct Gaps {
    std::vector<std::vector<double>> values;
    std::vector<int> lines;  // line of each row
    /// For each column with numbers, the first cell that is neither a number nor a word for a gap:
    /// `is "1,234" in line 7, expected ...`. Empty if there is none.
    std::vector<std::string> texts;
  };
  /// Returns columns with their gaps. An empty unit requests the numbers as they are written.
  Gaps numbers_and_gaps(const std::vector<Wanted>& columns) const;
  /// Returns the unit to request for a column that is in SI if the table states no unit: `unit`, or
  /// "1" for a column without unit.
  std::string si_or_plain(std::string_view column, std::string_view unit) const {
    return has_unit(column) ? std::string(unit) : "1";
  }
  /// Returns a column as numbers() does, but a column without a unit is assumed to be in SI.
  std::vector<double> si_numbers(std::string_view column, std::string_view unit) const;
  /// Returns integers without unit.
  std::vector<int> integers(std::string_view column) const;
  std::vector<std::string> texts(std::string_view column) const;
  std::string text(std::string_view column, int row) const;

  /// Returns every column in the SI unit of its dimension; all must be numbers.
  Channels channels() const;

  /// Throws InputError, naming all of them, if some of the `needed` columns are missing.
  void expect_columns(const std::vector<std::string>& needed) const;
  /// Throws InputError for a column that is not among the `known` ones.
  void expect_only(const std::vector<std::string>& known) const;

 private:
  int place_of(std::string_view column) const;  // -1 if it is missing
  int index(std::string_view column) const;
  Unit unit_of(int column, std::string_view unit) const;
  double number(const CsvFields::Row& row, int column, const Unit& unit, DecimalMarks& marks) const;
  double number_or_gap(const CsvFields::Row& row, int column, const Unit& unit) const;
  CsvFields data() const;  // positioned at the first row
  CsvFields::Row row_of(CsvFields& fields, int row) const;

  std::string file_;
  std::shared_ptr<const MappedFile> source_;
  bool decimal_comma_ = false;
  int header_line_ = 0;
  std::vector<TableColumn> columns_;
  int rows_ = 0;
  std::vector<CsvFields::Mark> marks_;  // positions of every kStride-th row of data
};

/// Returns a table of channels, "name [unit]", one line for each sample; a channel that is shorter
/// than others (the deflection of a modal test) leaves its cells empty. `units` has the unit of
/// each column; empty: SI. Reading a table of equal lengths gives the same bits.
std::string csv_text(const Channels& channels, const std::vector<std::string>& units = {});

/// The header and the rows of csv_text(), for tables that are written block by block.
std::string csv_header(const Channels& channels, const std::vector<std::string>& units = {});
std::string csv_rows(const Channels& channels, const std::vector<std::string>& units = {});

/// Returns a name or text as a field of a comma-separated line, in quotes if needed.
std::string csv_field(std::string_view text);

}  // namespace latsch::formats
