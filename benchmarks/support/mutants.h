// SPDX-License-Identifier: Apache-2.0
// Good files changed as people and programs change them: a column renamed, a unit dropped, another
// encoding. Each mutant knows what a reader may do with it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace latsch::benchmarks {

/// What a reader has to do with a mutant, beside refusing it, which is always right.
enum class Allowed {
  same_numbers,  // the meaning is the same, or the reader tells by name what is not
  told,          // the meaning is another one: the reader has to name the column or key
  the_rest,      // no channel has that name and dimension any more, so whoever needs it is refused;
                 // all others have the same numbers
};

struct Mutant {
  std::string change;  // "renames a column"
  std::string text;
  std::string touched;  // the column or key that was changed; empty: all of the file
  Allowed allowed = Allowed::same_numbers;
};

/// A separated-values file as its lines: comments, one line of names with units, numbers.
struct TableText {
  std::vector<std::string> comments;
  std::vector<std::string> names, units;  // "Fz", "N"; empty: without a unit
  std::vector<std::vector<std::string>> rows;

  std::string text(const std::string& separator = ",", const std::string& line_end = "\n") const;
};
/// nullopt for a file of another form.
std::optional<TableText> table_text(const std::string& text);

/// The mutants of a table. A change that this table has no place for is left out.
std::vector<Mutant> mutants_of_table(const TableText& good);

/// The mutants of a file of sections and keys (.tir).
std::vector<Mutant> mutants_of_sections(const std::string& good);

}  // namespace latsch::benchmarks
