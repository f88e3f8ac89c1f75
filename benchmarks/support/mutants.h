// SPDX-License-Identifier: Apache-2.0
// Good files changed as people and programs change them: a column renamed, a unit dropped, another
// encoding. Each mutant states how a reader may handle it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace latsch::benchmarks {

/// The required behavior of a reader for a mutant. Refusing it is always right.
enum class Allowed {
  same_numbers,  // the meaning is the same, or the reader names what is not
  told,          // the meaning differs: the reader has to name the column or key
  // No channel has that name and dimension any more, so its users are refused; all others have the
  // same numbers.
  the_rest,
};

struct Mutant {
  std::string change;  // "renames a column"
  std::string text;
  std::string touched;  // changed column or key; empty: the whole file
  Allowed allowed = Allowed::same_numbers;
};

/// A separated-values file as its lines: comments, one line of names with units, numbers.
struct TableText {
  std::vector<std::string> comments;
  std::vector<std::string> names, units;  // "Fz", "N"; empty: without a unit
  std::vector<std::vector<std::string>> rows;

  std::string text(const std::string& separator = ",", const std::string& line_end = "\n") const;
};
/// Returns nullopt for a file of another form.
std::optional<TableText> table_text(const std::string& text);

/// Returns the mutants of a table. Changes that do not apply to this table are left out.
std::vector<Mutant> mutants_of_table(const TableText& good);

/// Returns the mutants of a file of sections and keys (.tir).
std::vector<Mutant> mutants_of_sections(const std::string& good);

}  // namespace latsch::benchmarks
