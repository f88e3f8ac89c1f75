// SPDX-License-Identifier: Apache-2.0
// The table at the end of every benchmark: a line with the processor and the SIMD kernel set, then
// for each row what was measured, the value, the requirement, and whether it is met.
//
//   Table table("ccx", options);
//   table.row("Fz of the deck", fmt::format("{:.3f} %", 1e2 * error), "<= 0.2 %", error < 2e-3);
//   return table.exit_code();
//
// In a smoke run (options.h) the rows of full_row() are printed and not judged: times of this
// machine, and shares of many cases of which a smoke run computes few.
#pragma once

#include <string>
#include <string_view>

#include "options.h"

namespace latsch::benchmarks {

/// Prints each row when it is known, so that an interrupted run shows its progress.
class Table {
 public:
  /// Exit code of a smoke run for which a program or a file is missing: the tests count it as
  /// skipped.
  static constexpr int kSkipped = 77;

  Table(std::string_view name, const Options& options);

  /// Adds a row that every run judges: the measured quantity, its value, the required range, and
  /// whether the value is in it.
  void row(std::string_view what, std::string_view value, std::string_view reach, bool ok);
  /// Adds a row that only the full run judges.
  void full_row(std::string_view what, std::string_view value, std::string_view reach, bool ok);
  /// Adds a figure without requirement.
  void note(std::string_view what, std::string_view value);
  /// Reports a program or file that is missing on this machine. A full run then fails; a smoke run
  /// counts as skipped.
  void skip(std::string_view what, std::string_view reason);

  /// Prints the closing line. Returns 0 if the table has rows and every judged row is ok, kSkipped
  /// if a smoke run was skipped and no row failed, and 1 otherwise.
  int exit_code() const;

 private:
  std::string name_;
  bool is_smoke_;
  int rows_ = 0;
  int notes_ = 0;
  int short_ = 0;
  int skipped_ = 0;
};

}  // namespace latsch::benchmarks
