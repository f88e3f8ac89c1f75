// SPDX-License-Identifier: Apache-2.0
// Describes a column of a file, and splits its title into name and unit in common notations.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/units.h"

namespace latsch::formats {

/// Position at which a file states the unit of a column.
enum class UnitPlace {
  title,                 // "force [N]"
  title_without_blanks,  // "force[N]": blanks separate the columns
  row_below,             // in a row of units below the names
  field,                 // in a separate field, as in TYDEX
  text_beside            // in a text beside the numbers: `Fz.unit` of `Fz.data` in a MAT file
};

/// A column, channel or vector as its file states it.
struct TableColumn {
  std::string name;          // without the unit
  std::string unit = {};     // text in the file; empty: none
  std::string title = {};    // the whole text of the name, "force [N]"
  int line = 0;              // line of the name, from 1; 0: the file has no lines
  int unit_line = 0;         // line of the unit
  int place = 0;             // among the columns, from 1
  std::string assumed = {};  // the meaning that was assumed for a unit with several meanings
  UnitPlace unit_place = UnitPlace::title;
  bool is_negative = false;  // the title is minus the name: "-SA" holds minus SA
  // Scaling that a TYDEX file states: value in `unit` = written number * factor + offset.
  double factor = 1.0, offset = 0.0;

  bool operator==(const TableColumn&) const = default;
};

/// Splits a title such as "force [N]", "force (N)" or "force / N" into "force" and "N". Square
/// brackets always contain a unit. The other forms are split only if the text is a unit; single
/// letters that also name a frame, a side or an axle ("Fz (H)", "toe (L)") are no units there.
TableColumn column_of_title(std::string_view title);

/// A function that returns the SI unit that a column with the given name must have; "" if the name
/// does not determine it.
using ExpectedUnit = std::function<std::string(const std::string& name)>;

/// Removes the minus of a name such as "-SA" and marks the column as negative. Does nothing if no
/// letter follows the minus.
void take_minus_of_name(TableColumn& column);

/// Sets the unit of a column without unit to the one that ends its name, such as "deg" in
/// "alpha_deg", if it has the dimension of the SI unit `expected`. Does nothing otherwise.
void take_unit_of_name(TableColumn& column, const std::string& expected);

/// Returns the unit of a column. `expected` is the SI unit of the values; empty: not known. An
/// assumption is recorded in the column. Throws InputError at `place` if the unit is unknown, has
/// several meanings none of which is usual, or has another dimension than expected, and if a unit
/// is needed and the column has none.
Unit unit_of_column(TableColumn& column, const std::string& expected, const Place& place);
/// Returns the error message about the unit of a column, such as `column "FZ" has unknown unit
/// "kgg"`; "" if the unit is right.
std::string fault_of_unit(const TableColumn& column, const std::string& expected);

/// Returns in words how to write a unit for the column into its file: `"force [N]"`, `"N" below
/// "force" in line 2`.
std::string unit_in_file(const TableColumn& column, const std::string& unit);

/// Applies the unit that a user states for a column. It must equal the unit in the file, if the
/// file states one; otherwise it becomes the column's unit. An empty text states nothing. Throws
/// InputError at `place` if the two differ.
void take_stated_unit(TableColumn& column, const std::string& stated, const Place& place);

/// Returns an error message about missing columns: `column "Fz" is missing, did you mean "FZ"?
/// (columns: ...)`.
std::string missing_columns(const std::vector<std::string>& missing,
                            const std::vector<std::string>& names);

/// Returns in words why a cell is no number, beginning with a comma: `, a decimal comma: ...`,
/// thousands separators, or `, expected a finite number`.
std::string reason_of_no_number(std::string_view cell, std::string_view kind_of_file);
/// True if a cell says in words that there is no value: empty, "NaN", "n/a", "-" and similar.
bool is_gap_word(std::string_view cell);

/// Notices if a file has both decimal commas and decimal points: beside "0.5", "1,234" means more
/// than a thousand; beside "0,5" it means little more than one.
class DecimalMarks {
 public:
  explicit DecimalMarks(std::string file) : file_(std::move(file)) {}
  /// Adds a number as written. Throws InputError if the file has both marks and a number may have a
  /// thousands separator.
  void take(std::string_view number, int line);

 private:
  std::string file_;
  int comma_line_ = 0, point_line_ = 0;
  bool has_comma_group_ = false, has_point_group_ = false;
};

}  // namespace latsch::formats
