// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/placed_tire.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "base/document.h"
#include "base/error.h"
#include "cli/templates/tire_lines.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {

std::string columns_line(const std::vector<double>& columns) {
  return fmt::format("columns = [{:g}]", fmt::join(columns, ", "));
}

std::string placed_tire(std::string_view text, const std::vector<double>& columns, int sectors) {
  const std::string line = columns_line(columns);
  std::string placed = by_lines(text, [&](const std::string& old) -> std::string {
    if (old.starts_with("meridional") || old.starts_with("columns")) return line + "\n";
    if (old.starts_with("sectors =")) return fmt::format("sectors = {}\n", sectors);
    return old.starts_with("spacing = [[") ? "" : old;
  });
  std::optional<InputError> error;
  try {
    const auto tire = fe_tire::read_tire(Document::parse(placed, "placed").root());
    if (tire.section.columns == columns && tire.section.sectors == sectors) return placed;
  } catch (const InputError& unread) {
    error = unread;
  }
  throw InputError(
      "expected [mesh] to have a line that begins with meridional or columns, and one that begins "
      "with sectors; write these lines by hand in place of meridional, spacing and sectors:\n" +
      line + fmt::format("\nsectors = {}", sectors) +
      (error ? std::string("\n(") + error->what() + ")" : ""));
}

}  // namespace latsch::cli
