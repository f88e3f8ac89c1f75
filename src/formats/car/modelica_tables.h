// SPDX-License-Identifier: Apache-2.0
// Writes tables as a text file for the blocks CombiTable1Ds, CombiTable1Dv and CombiTable2Ds of the
// Modelica Standard Library [Modelica.Blocks.Tables]:
//
//   #1
//   double NAME(rows,columns)   # comment
//   numbers, row by row
//
// A table in one dimension has its abscissa in the first column. A table in two dimensions has the
// first abscissa in its first column, the second one in its first row, and a 0 where they meet.
#pragma once

#include <string>
#include <vector>

namespace latsch::formats {

struct ModelicaTable {
  std::string name;     // letters, digits and underscores
  std::string comment;  // one line; empty: none
  std::vector<std::vector<double>> rows;
};

/// Returns the table of values(i, j) over `first`[i] and `second`[j]; values are in the order of i,
/// then j.
ModelicaTable table_of_two(std::string name,
                           std::string comment,
                           const std::vector<double>& first,
                           const std::vector<double>& second,
                           const std::vector<double>& values);

/// Returns the text of the file, with the given lines as comments behind its first line. All rows
/// of a table must have the same length.
std::string modelica_text(const std::vector<std::string>& comments,
                          const std::vector<ModelicaTable>& tables);

}  // namespace latsch::formats
