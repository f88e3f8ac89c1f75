// SPDX-License-Identifier: Apache-2.0
// The table every benchmark ends in: processor and kernel set, then what was measured, the value,
// what it has to reach, and whether it does.
//
//   Table table("ccx");
//   table.row("Fz against the deck", fmt::format("{:.3f} %", 100 * error), "<= 0.2 %", error <=
//   2e-3); return table.exit_code();
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace latsch::benchmarks {

/// Prints each row when it is known, so that an interrupted run shows how far it came.
class Table {
 public:
  explicit Table(std::string_view name);

  void row(std::string_view what, std::string_view value, std::string_view reach, bool ok);
  /// A figure without anything to reach.
  void note(std::string_view what, std::string_view value);

  /// Prints the closing line. 0 where every row is ok and there is one, 1 otherwise.
  int exit_code() const;

 private:
  std::string name_;
  int rows_ = 0;
  int notes_ = 0;
  int short_ = 0;
};

/// What main() does: runs the benchmark and gives back its exit code. What it throws, a study that
/// cannot be read for instance, is printed; then 2.
int guarded(const std::function<int()>& benchmark);

}  // namespace latsch::benchmarks
