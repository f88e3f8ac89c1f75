// SPDX-License-Identifier: Apache-2.0
// Description of a column in a file, and its title with a unit in common notations.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/units.h"

namespace latsch::formats {

/// The position at which a file states the unit of a column.
enum class UnitPlace {
  title,                 // "force [N]"
  title_without_blanks,  // "force[N]": there are blanks between the columns
  row_below,             // in a row of units below the row of names
  field,                 // a field of its own, as in TYDEX
  text_beside            // a text beside the numbers: `Fz.unit` of `Fz.data` in a MAT file
};

/// A column, channel or vector as its file states it.
struct TableColumn {
  std::string name;          // without the unit
  std::string unit = {};     // text in the file; empty: none
  std::string title = {};    // the whole text of the name, "force [N]"
  int line = 0;              // line of the name, from 1; 0: the file has no lines
  int unit_line = 0;         // line of the unit
  int place = 0;             // among the columns, from 1
  std::string assumed = {};  // for a unit with several meanings, the assumed one
  UnitPlace unit_place = UnitPlace::title;
  bool is_negative = false;  // the title is minus the name: "-SA" holds minus SA
  // The file's own scaling (TYDEX): a value in `unit` is the written number * factor + offset.
  double factor = 1.0, offset = 0.0;

  bool operator==(const TableColumn&) const = default;
};

/// Splits "force [N]", "force (N)" and "force / N" into "force" and "N". Square brackets always
/// contain a unit; the other forms only if the text is a unit, and single letters that also name a
/// frame, a side or an axle ("Fz (H)", "toe (L)") are none.
TableColumn column_of_title(std::string_view title);

/// Returns the SI unit that a column of the given name must have; "" if the name does not say.
using ExpectedUnit = std::function<std::string(const std::string& name)>;

/// Takes the minus off a name such as "-SA" and marks the column as negative. Does nothing if no
/// letter follows the minus.
void take_minus_of_name(TableColumn& column);

/// Uses the unit that ends a name, "deg" in "alpha_deg", for a column without a unit whose SI unit
/// `expected` is known. Does nothing if the last word is no unit of that dimension.
void take_unit_of_name(TableColumn& column, const std::string& expected);

/// Returns the unit of a column. `expected` is the SI unit of the values; empty: not known. Records
/// in the column what was assumed. Throws InputError at `place` for a unit that is unknown, has
/// several meanings of which none is usual, or has another dimension than expected, and if a unit
/// is needed and the column has none.
Unit unit_of_column(TableColumn& column, const std::string& expected, const Place& place);
/// Returns the error message `column "FZ" has unknown unit "kgg"`; "" if the unit is right.
std::string fault_of_unit(const TableColumn& column, const std::string& expected);

/// Returns how to write a unit for the column into its file: `"force [N]"`,
/// `"N" below "force" in line 2`.
std::string unit_in_file(const TableColumn& column, const std::string& unit);

/// Applies the unit that a user states for a column. It must equal the unit in the file, if the
/// file states one; otherwise it becomes the column's unit. An empty text states nothing. Throws
/// InputError at `place` if the two differ.
void take_stated_unit(TableColumn& column, const std::string& stated, const Place& place);

/// Returns `column "Fz" is missing, did you mean "FZ"? (columns: ...)`, also for several columns at
/// once.
std::string missing_columns(const std::vector<std::string>& missing,
                            const std::vector<std::string>& names);

/// Says why a cell is no number: a decimal comma, thousands separators, or `expected a finite
/// number`. Begins with a comma: `, a decimal comma: ...`.
std::string reason_of_no_number(std::string_view cell, std::string_view kind_of_file);
/// True if a cell says in words that there is no value: empty, "NaN", "n/a", "-" and similar.
bool is_gap_word(std::string_view cell);

/// Detects decimal commas and decimal points in one file: beside "0.5", "1,234" is more than a
/// thousand; beside "0,5" it is little more than one.
class DecimalMarks {
 public:
  explicit DecimalMarks(std::string file) : file_(std::move(file)) {}
  /// Throws InputError if the file has both marks and a number may have a thousands separator.
  void take(std::string_view number, int line);

 private:
  std::string file_;
  int comma_line_ = 0, point_line_ = 0;
  bool has_comma_group_ = false, has_point_group_ = false;
};

}  // namespace latsch::formats
