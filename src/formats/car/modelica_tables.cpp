// SPDX-License-Identifier: Apache-2.0
#include "formats/car/modelica_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>

namespace latsch::formats {

ModelicaTable table_of_two(std::string name,
                           std::string comment,
                           const std::vector<double>& first,
                           const std::vector<double>& second,
                           const std::vector<double>& values) {
  assert(values.size() == first.size() * second.size());
  ModelicaTable table = {std::move(name), std::move(comment), {}};
  table.rows.push_back({0.0});
  table.rows.back().insert(table.rows.back().end(), second.begin(), second.end());
  for (std::size_t i = 0; i < first.size(); ++i) {
    std::vector<double> row = {first[i]};
    for (std::size_t j = 0; j < second.size(); ++j) row.push_back(values[i * second.size() + j]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string modelica_text(const std::vector<std::string>& comments,
                          const std::vector<ModelicaTable>& tables) {
  std::string text = "#1\n";
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  for (const ModelicaTable& table : tables) {
    const std::size_t columns = table.rows.empty() ? 0 : table.rows.front().size();
    text += fmt::format("double {}({},{})", table.name, table.rows.size(), columns);
    text += (table.comment.empty() ? "" : "   # " + table.comment) + "\n";
    for (const std::vector<double>& row : table.rows) {
      assert(row.size() == columns);
      text += fmt::format("{}\n", fmt::join(row, " "));
    }
  }
  return text;
}

}  // namespace latsch::formats
