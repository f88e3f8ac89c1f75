// SPDX-License-Identifier: Apache-2.0
#include "correlation/selection/selected_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <set>
#include <sstream>
#include <vector>

#include "base/file.h"
#include "base/text.h"
#include "base/units.h"

namespace latsch::correlation {
namespace {

constexpr const char* kStageOfSelection = "selected";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Returns the value as the study file writes it: 1.4, or "0.5 MN/m^2".
std::string as_written(double si, const std::string& unit) {
  const std::string number = Unit::of(unit).exact_number(si);
  return unit == "1" ? number : "\"" + number + " " + unit + "\"";
}

/// Replaces the value of `initial` in the table of a variable; its comment stays. Returns false if
/// there is no such line.
bool replace_initial(std::vector<std::string>& lines,
                     const std::string& variable,
                     const std::string& value) {
  bool is_inside = false;
  for (std::string& line : lines) {
    const std::string_view text = trimmed(line);
    if (text.starts_with("[")) {
      const std::string header(text.substr(0, text.find(']')));
      is_inside = header == "[variable." + variable || header == "[variable.\"" + variable + "\"";
      continue;
    }
    if (!is_inside || !text.starts_with("initial")) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    // a comment begins at the first # outside of a text
    bool is_text = false;
    std::size_t comment = line.size();
    for (std::size_t k = equals; k < line.size() && comment == line.size(); ++k) {
      if (line[k] == '"') is_text = !is_text;
      if (line[k] == '#' && !is_text) comment = k;
    }
    const std::string behind = line.substr(comment);
    line = line.substr(0, equals) + "= " + value + (behind.empty() ? "" : "  " + behind);
    return true;
  }
  return false;
}

}  // namespace

std::filesystem::path selected_study_file(const Study& study) {
  return std::filesystem::path(study.file).replace_extension(".selected.toml");
}

std::filesystem::path selection_table_file(const Study& study) {
  return std::filesystem::path(study.file).replace_extension(".selection.csv");
}

Result<std::string> selected_study_text(const Study& study, const StudySelection& selected) {
  const std::vector<int> free = selected.selection.free_variables(selected.chosen());
  std::vector<std::string> kept, held;
  for (const int i : free) kept.push_back(in_quotes(study.space[i].name));
  std::vector<std::string> lines = lines_of(read_text_file(study.file));
  const bool has_stages = std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return trimmed(line).starts_with("[stage.");
  });
  if (kept.empty()) return Failure{"no variable is kept, so there is nothing to fit"};
  if (has_stages)
    return Failure{
        fmt::format("the study has stages of its own: write free = [{}] into each of them",
                    fmt::join(kept, ", "))};
  const std::set<int> kept_units(selected.chosen().units.begin(), selected.chosen().units.end());
  for (std::size_t k = 0; k < selected.settings.units.size(); ++k) {
    if (kept_units.contains(static_cast<int>(k))) continue;
    for (const int i : selected.settings.units[k].variables) {
      const DesignVariable& variable = study.space[i];
      const double value = selected.settings.toward[static_cast<std::size_t>(i)];
      held.push_back(
          fmt::format("{} = {}", variable.name, format_quantity(value, variable.unit, 6)));
      if (value == variable.initial) continue;
      if (!replace_initial(lines, variable.name, as_written(value, variable.unit)))
        return Failure{fmt::format(
            "the file has no line initial = ... in a table [variable.{}], which would hold it at "
            "{}: write such a table",
            variable.name,
            format_quantity(value, variable.unit, 6))};
    }
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  text += fmt::format("\n# latsch select keeps {} of {} variables by {}.\n",
                      kept.size(),
                      study.space.size(),
                      in_words(selected.settings.criterion));
  for (const std::string& one : held) text += "# It holds " + one + ".\n";
  text += fmt::format("[stage.{}]\nfree = [{}]\n", kStageOfSelection, fmt::join(kept, ", "));
  return text;
}

void write_selection_table(const Study& study,
                           const StudySelection& selected,
                           const std::filesystem::path& file) {
  const Confidence c = selected.intervals();
  const DesignPoint point = selected.point(study.space, selected.reported());
  const auto& units = selected.chosen().units;
  write_file(file, [&](std::ostream& out) {
    out << "candidate,variable,unit,kept,round,rise,value,lower,upper\n";
    for (std::size_t k = 0; k < selected.settings.units.size(); ++k) {
      const bool is_kept = std::binary_search(units.begin(), units.end(), static_cast<int>(k));
      const double rise =
          is_kept ? selected.chosen().rises[static_cast<std::size_t>(
                        std::find(units.begin(), units.end(), static_cast<int>(k)) - units.begin())]
                  : selected.selection.fates()[k].rise;
      for (const int i : selected.settings.units[k].variables) {
        const DesignVariable& variable = study.space[i];
        const Unit unit = Unit::of(variable.unit);
        const auto at = static_cast<std::size_t>(i);
        const auto end = [&](double u) {
          if (!std::isfinite(u)) return u;
          std::vector<double> all = study.space.to_unit(point);
          all[at] = std::clamp(u, 0.0, 1.0);
          return unit.from_si(study.space.from_unit(all).values[at]);
        };
        out << fmt::format("{},{},{},{},{},{:.6g},{:.12g},{:.12g},{:.12g}\n",
                           selected.settings.units[k].name,
                           variable.name,
                           variable.unit,
                           is_kept ? 1 : 0,
                           is_kept ? 0 : selected.selection.fates()[k].round,
                           rise,
                           unit.from_si(point.values[at]),
                           end(c.intervals[at].lower),
                           end(c.intervals[at].upper));
      }
    }
  });
}

}  // namespace latsch::correlation
