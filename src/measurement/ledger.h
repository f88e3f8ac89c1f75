// SPDX-License-Identifier: Apache-2.0
// The ledger of a file: for every column or key that stands in the file, what it was taken for and
// who uses it.
//
//   written   taken as   unit written   meaning, factor      axes, sign     used by
//   SA        alpha      deg            rad, 0.0174533       sae, -1        test steady
//   TSTC      -          C              K, 1, + 273.15       not turned     not used
//   (none)    p          -              -                    -              assumed: 220 kPa
//
// The reader of a file builds the rows while it reads, because only the reader knows what it did.
// Whoever takes a channel later adds itself to `used_by`. Printers, pages and JSON show the rows
// and decide nothing.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace latsch {

enum class LedgerState {
  used,      // somebody takes it; `used_by` says who
  not_used,  // it was read or recognized, and nobody takes it
  assumed,   // it stands nowhere in the file; `remark` says which value is taken and why
  doubtful,  // its meaning is not certain: "?"; `remark` says why
};
/// "used", "not used", "assumed", "?"
const char* name_of(LedgerState state);

struct LedgerRow {
  std::string written = {};       // the name as the file has it; empty for what is assumed
  int line = 0, column = 0;       // of the name, from 1; 0 where that is not known
  std::string taken_as = {};      // the channel or parameter; empty: the name is not known
  std::string meaning = {};       // "slip angle"; empty: not known
  std::string unit_written = {};  // empty: the file names none
  std::string unit = {};          // the SI unit after reading
  double factor = 1.0;            // SI value = written number * factor + offset
  double offset = 0.0;
  std::string axes = {};  // "sae, -1", "sae, +1", "not turned"; empty: the file states no axes
  std::vector<std::string> used_by = {};  // "test steady", "experiment Fy", "select"
  LedgerState state = LedgerState::not_used;
  std::string remark = {};

  bool operator==(const LedgerRow&) const = default;
};

/// A fault or doubt of one row that a person has to know. It names the column or key.
struct LedgerDoubt {
  std::string name;  // as written in the file
  std::string sentence;
  Place place = {};
  bool is_error = false;  // else a warning

  bool operator==(const LedgerDoubt&) const = default;
};

struct Ledger {
  std::string file;
  std::vector<LedgerRow> rows = {};
  std::vector<LedgerDoubt> doubts = {};

  /// The row of a name as written; nullptr where there is none.
  LedgerRow* find_written(const std::string& name);
  const LedgerRow* find_written(const std::string& name) const;
  /// The row that became a channel or parameter; nullptr where there is none.
  LedgerRow* find_taken(const std::string& name);
  const LedgerRow* find_taken(const std::string& name) const;
  /// Marks a row as used by somebody, once for each name.
  static void use(LedgerRow& row, const std::string& by);
};

/// "12 columns: 9 used, 2 not used (`NFX`, `TSTC`), 1 assumed: pressure 220 kPa". `what` is the
/// word for a row that stands in the file, in the singular.
std::string in_one_line(const Ledger& ledger, const std::string& what = "column");

/// The table that `latsch show` prints: the heads, then a line a row.
std::vector<std::string> ledger_heads();
std::vector<std::string> ledger_cells(const LedgerRow& row);

}  // namespace latsch
