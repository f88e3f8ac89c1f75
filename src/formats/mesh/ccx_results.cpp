// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/ccx_results.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "base/error.h"

namespace latsch::formats {
namespace {

/// Returns the numbers of a line; nothing if it contains anything else.
std::optional<std::vector<double>> numbers(const std::string& line) {
  std::istringstream fields(line);
  fields.imbue(std::locale::classic());
  std::vector<double> values;
  double value = 0.0;
  while (fields >> value) values.push_back(value);
  if (!fields.eof() || values.empty()) return {};
  return values;
}

/// Returns the set's name from a title: "RIM" from " total force (fx,fy,fz) for set RIM and time
/// 0.1E+01".
std::string set_name(const std::string& title) {
  const auto from = title.find("for set ") + 8, to = title.find(" and time", from);
  return title.substr(from, to - from);
}

enum class Table { none, force, displacement, frequency };

Table table_of(const std::string& line) {
  if (line.find("total force (") != std::string::npos) return Table::force;
  if (line.find("displacements (") != std::string::npos) return Table::displacement;
  if (line.find("E I G E N V A L U E   O U T P U T") != std::string::npos) return Table::frequency;
  return Table::none;
}

}  // namespace

CcxResults parse_ccx_results(std::string_view text, const std::string& file_name) {
  CcxResults results;
  std::istringstream stream{std::string(text)};
  Table table = Table::none;
  std::string line, title;
  int number = 0, rows = 0;
  const auto expect = [&](const std::vector<double>& row, std::size_t count) {
    if (row.size() != count)
      throw InputError({file_name, number},
                       fmt::format("a row of {} numbers, expected {}", row.size(), count));
  };
  while (std::getline(stream, line)) {
    ++number;
    if (const Table next = table_of(line); next != Table::none) {
      table = next;
      title = line;
      rows = 0;
      continue;
    }
    const auto row = numbers(line);
    // column headings may precede the first row; any other text after a row ends the table
    if (!row) {
      if (rows > 0 && line.find_first_not_of(" \t\r") != std::string::npos) table = Table::none;
      continue;
    }
    ++rows;
    if (table == Table::force) {
      expect(*row, 3);
      results.total_force.emplace(set_name(title),
                                  Eigen::Vector3d((*row)[0], (*row)[1], (*row)[2]));
    } else if (table == Table::displacement) {
      expect(*row, 4);
      results.displacement.emplace(static_cast<int>((*row)[0]),
                                   Eigen::Vector3d((*row)[1], (*row)[2], (*row)[3]));
    } else if (table == Table::frequency) {
      expect(*row, 5);
      results.frequencies.push_back((*row)[3]);
    }
  }
  return results;
}

CcxResults read_ccx_results(const std::filesystem::path& dat_file) {
  std::ifstream stream(dat_file);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError({dat_file.string(), 0}, "cannot be read");
  return parse_ccx_results(text.view(), dat_file.string());
}

}  // namespace latsch::formats
