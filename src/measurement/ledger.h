// SPDX-License-Identifier: Apache-2.0
// The ledger of a file says for every column or key of the file how it was interpreted and who uses
// it.
//
//   written   taken as   unit written   meaning, factor      axes, sign     used by
//   SA        alpha      deg            rad, 0.0174533       sae, -1        test steady
//   TSTC      -          C              K, 1, + 273.15       not turned     not used
//   (none)    p          -              -                    -              assumed: 220 kPa
//
// The reader of a file builds the rows while it reads, because only the reader knows what it did.
// Code that uses a channel later adds itself to `used_by`. Printers, pages and JSON show the rows
// and decide nothing.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace latsch {

enum class LedgerState {
  used,      // in use; `used_by` names the users
  not_used,  // read or recognized, but not used
  assumed,   // absent from the file; `remark` says which value is assumed and why
  doubtful,  // its meaning is not certain: "?"; `remark` has the reason
};
/// Returns "used", "not used", "assumed" or "?".
const char* name_of(LedgerState state);

struct LedgerRow {
  std::string written = {};       // name in the file; empty for an assumed value
  int line = 0, column = 0;       // position of the name, from 1; 0: not known
  std::string taken_as = {};      // channel or parameter; empty: the name is not known
  std::string meaning = {};       // "slip angle"; empty: not known
  std::string unit_written = {};  // unit in the file; empty: the file names none
  std::string unit = {};          // the SI unit after reading
  double factor = 1.0;            // SI value = written number * factor + offset
  double offset = 0.0;
  std::string axes = {};  // "sae, -1", "sae, +1", "not turned"; empty: the file states no axes
  std::vector<std::string> used_by = {};  // "test steady", "experiment Fy", "select"
  LedgerState state = LedgerState::not_used;
  std::string remark = {};

  bool operator==(const LedgerRow&) const = default;
};

/// An error or doubt about one row that the user has to know. It names the column or key.
struct LedgerDoubt {
  std::string name;  // name in the file
  std::string sentence;
  Place place = {};
  bool is_error = false;  // true for an error, false for a warning

  bool operator==(const LedgerDoubt&) const = default;
};

struct Ledger {
  std::string file;
  std::vector<LedgerRow> rows = {};
  std::vector<LedgerDoubt> doubts = {};

  /// Returns the row with the given name in the file; nullptr if there is none.
  LedgerRow* find_written(const std::string& name);
  const LedgerRow* find_written(const std::string& name) const;
  /// Returns the row that became the given channel or parameter; nullptr if there is none.
  LedgerRow* find_taken(const std::string& name);
  const LedgerRow* find_taken(const std::string& name) const;
  /// Marks a row as used by `by`; a name that is already recorded is not added again.
  static void use(LedgerRow& row, const std::string& by);
};

/// Returns a summary such as "12 columns: 9 used, 2 not used (`NFX`, `TSTC`), 1 assumed: pressure
/// 220 kPa". `what` is the singular word for a row of the file.
std::string in_one_line(const Ledger& ledger, const std::string& what = "column");

/// Returns the column heads of the table that `latsch show` prints.
std::vector<std::string> ledger_heads();
std::vector<std::string> ledger_cells(const LedgerRow& row);

}  // namespace latsch
