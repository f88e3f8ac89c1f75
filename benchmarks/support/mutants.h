// SPDX-License-Identifier: Apache-2.0
// Good files changed as people and programs change them: a column renamed, a unit dropped, another
// encoding. Each changed file, a mutant, states how a reader may handle it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace latsch::benchmarks {

/// The behavior that a mutant requires of a reader. Refusing the file is always right.
enum class Allowed {
  same_numbers,  // the numbers keep their meaning, or the reader names those that do not
  told,          // the meaning differs, and the reader has to name the column or key
  // The changed column is no longer a channel of its name and dimension, so its users are refused;
  // all other channels have the same numbers.
  the_rest,
};

struct Mutant {
  std::string change;  // "renames a column"
  std::string text;
  std::string touched;  // name of the changed column or key; empty: the whole file
  Allowed allowed = Allowed::same_numbers;
};

/// The lines of a table of separated values: comments, one line of names with units, numbers.
struct TableText {
  std::vector<std::string> comments;
  /// names and units of the columns, such as "Fz" and "N"; the unit is empty if a column has none
  std::vector<std::string> names, units;
  std::vector<std::vector<std::string>> rows;

  std::string text(const std::string& separator = ",", const std::string& line_end = "\n") const;
};
/// Returns the table in the text; nullopt if the text has another form.
std::optional<TableText> table_text(const std::string& text);

/// Returns the mutants of a table. Changes that do not apply to this table are left out.
std::vector<Mutant> mutants_of_table(const TableText& good);

/// Returns the mutants of a file of sections and keys (.tir).
std::vector<Mutant> mutants_of_sections(const std::string& good);

}  // namespace latsch::benchmarks
