// SPDX-License-Identifier: Apache-2.0
#include "formats/car/hardpoint_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "formats/tables/csv_table.h"

namespace latsch::formats {
namespace {

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

/// True if the text can be used as a bare key of TOML.
bool is_name(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// Returns for each row whether it belongs to the chosen corner.
std::vector<bool> chosen_rows(const CsvTable& table, const std::optional<std::string>& of) {
  std::vector<bool> chosen(static_cast<std::size_t>(table.rows()), true);
  if (!table.has("of")) {
    if (of)
      throw InputError(table.header_place(),
                       "has no column `of`, which would list the points of " + in_quotes(*of));
    return chosen;
  }
  const auto corners = table.texts("of");
  std::vector<std::string> there;
  for (const std::string& corner : corners)
    if (std::find(there.begin(), there.end(), corner) == there.end()) there.push_back(corner);
  if (!of && there.size() == 1) return chosen;
  if (!of || std::find(there.begin(), there.end(), *of) == there.end())
    throw InputError(table.header_place(),
                     fmt::format("has points of {}: {}; hardpoints_of says which are meant",
                                 fmt::join(there, ", "),
                                 of ? "none of " + in_quotes(*of) : "of several corners"));
  std::transform(corners.begin(), corners.end(), chosen.begin(), [&](const std::string& corner) {
    return corner == *of;
  });
  return chosen;
}

/// Checks that the cell is a number but returns its text as written.
std::string written(const CsvTable& table, const char* axis, int row) {
  std::string text = table.text(axis, row);
  std::replace(text.begin(), text.end(), ',', '.');
  return text + " " + table.unit(axis);
}

}  // namespace

std::vector<Hardpoint> read_hardpoints(const std::filesystem::path& file,
                                       const std::optional<std::string>& of) {
  const CsvTable table = CsvTable::read(file);
  table.expect_only({"of", "name", "x", "y", "z"});
  const auto chosen = chosen_rows(table, of);
  const auto names = table.texts("name");
  // Also checks that all coordinates have a unit of length.
  table.numbers({{"x", "m"}, {"y", "m"}, {"z", "m"}});
  std::vector<Hardpoint> points;
  std::map<std::string, int> lines;
  for (int row = 0; row < table.rows(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    if (!chosen[i]) continue;
    if (!is_name(names[i]))
      throw InputError(table.place(row),
                       in_quotes(names[i]) + " is not a name of a point, expected one such as ubj");
    const int line = table.place(row).line;
    if (const auto [before, is_new] = lines.emplace(names[i], line); !is_new)
      throw InputError(table.place(row),
                       fmt::format("{} comes twice, before in line {}", names[i], before->second));
    Hardpoint point{.name = names[i], .place = {}, .line = line};
    for (std::size_t axis = 0; axis < 3; ++axis)
      point.place[axis] = written(table, kAxes[axis], row);
    points.push_back(std::move(point));
  }
  if (points.empty()) throw InputError(table.header_place(), "has no points");
  return points;
}

}  // namespace latsch::formats
