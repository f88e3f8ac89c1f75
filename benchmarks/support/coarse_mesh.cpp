// SPDX-License-Identifier: Apache-2.0
#include "coarse_mesh.h"

#include <fmt/format.h>

#include <array>
#include <sstream>

#include "base/document.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::benchmarks {
namespace {

/// Keys in the section [mesh] of a tire file that set the length and width of its elements.
constexpr std::array kReplaced{
    "columns", "split_columns", "spacing", "meridional", "sectors", "sector_zones"};

bool is_replaced(const std::string& line) {
  for (const std::string key : kReplaced)
    if (line.starts_with(key + " ") || line.starts_with(key + "=")) return true;
  return false;
}

}  // namespace

std::string with_coarse_mesh(const std::string& tire, const CoarseMesh& mesh) {
  std::istringstream in(tire);
  std::string text;
  bool is_in_mesh = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('[')) is_in_mesh = line.starts_with("[mesh]");
    if (is_in_mesh && is_replaced(line)) continue;
    text += line + '\n';
    if (is_in_mesh && line.starts_with('['))
      text += fmt::format("meridional = {}\nsectors = {}\n", mesh.meridional, mesh.sectors);
  }
  const fe_tire::Section section =
      fe_tire::read_tire(Document::parse(text, "coarse tire").root()).section;
  if (section.meridional != mesh.meridional || section.sectors != mesh.sectors ||
      !section.columns.empty() || !section.sector_zones.empty()) {
    throw InputError("the tire's [mesh] has keys that with_coarse_mesh does not know");
  }
  return text;
}

}  // namespace latsch::benchmarks
