// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/magic_formula_stages.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace latsch::cli {
namespace {

// Upper bound of QCZ1, the shape factor C of the pneumatic trail. Far from zero slip the trail
// tends to at least cos(C pi/2) of its peak, -0.31 for C = 1.2. A larger bound would let the
// aligning moment change its sign further beyond the data.
constexpr double kMostQCZ1 = 1.2;

/// Returns the stages with all coefficients that the forces of a test could determine, before its
/// load, camber and pressure levels are considered. The coefficients by which E depends on the sign
/// of the slip (PEY3, PEY4, QEZ4, QEZ5) are left out: they have no effect where the formula limits
/// E to 1, and a search spends many trials on them.
std::vector<Stage> every_stage_of(const TireTest& t) {
  std::vector<Stage> stages;
  if (t.cornering) {
    stages.push_back(
        {"Fy",
         {"Fy"},
         {"PCY1", "PDY1", "PEY1", "PKY1", "PHY1", "PVY1", "PDY2", "PEY2", "PKY2", "PHY2", "PVY2"}});
    stages.push_back(
        {"Fy_conditions",
         {"Fy"},
         {"PDY3", "PKY3", "PKY6", "PVY3", "PKY7", "PVY4", "PPY1", "PPY3", "PPY2", "PPY4", "PPY5"}});
    if (t.side_lag && t.side_lag->is_seen())
      stages.push_back({"relaxation_y", {"Fy"}, {"LATERAL_STIFFNESS"}});
  }
  if (t.driving) {
    stages.push_back(
        {"Fx", {"Fx"}, {"PCX1", "PDX1", "PEX1", "PKX1", "PHX1", "PVX1", "PDX2", "PKX2", "PKX3"}});
    if (t.combined)
      for (const char* combined : {"RBX1", "RBX2", "RCX1"})
        stages.back().coefficients.emplace_back(combined);
    stages.push_back({"Fx_conditions", {"Fx"}, {"PDX3", "PPX1", "PPX2", "PPX3", "PPX4"}});
    if (t.drive_lag && t.drive_lag->is_seen())
      stages.push_back({"relaxation_x", {"Fx"}, {"LONGITUDINAL_STIFFNESS"}});
  }
  if (t.combined) stages.push_back({"combined", {"Fy_driven"}, {"RBY1", "RBY2", "RCY1", "RHY1"}});
  if (t.cornering && t.has("Mz")) {
    stages.push_back({"Mz",
                      {"Mz"},
                      {"QBZ1",
                       "QBZ9",
                       "QCZ1",
                       "QDZ1",
                       "QDZ6",
                       "QEZ1",
                       "QHZ1",
                       "QBZ2",
                       "QDZ2",
                       "QDZ7",
                       "QEZ2",
                       "QHZ2"}});
    stages.push_back({"Mz_conditions",
                      {"Mz"},
                      {"QBZ4", "QBZ5", "QDZ3", "QDZ8", "QHZ3", "QDZ9", "QHZ4", "PPZ1", "PPZ2"}});
  }
  if (t.has("Mx")) {
    // QSX10 lets the effect of camber depend on the load, beside QSX2, and QSX13 and QSX14 give the
    // side force a lever arm of its own, beside QSX3. Without them Mx of a race tire has an RMS
    // error of 7.1 % of its peak at two fitted pressures, with them 3.8 %.
    stages.push_back({"Mx", {"Mx"}, {"QSX1", "QSX2", "QSX10"}});
    if (t.cornering)
      for (const char* sheared : {"QSX3", "QSX13", "QSX14"})
        stages.back().coefficients.emplace_back(sheared);
  }
  if (t.has("My")) stages.push_back({"My", {"My"}, {"QSY1", "QSY3"}});
  return stages;
}

/// Bounds narrower than the usual range of a coefficient. They keep a tire plausible beyond the
/// data.
struct Bounds {
  std::string_view coefficient;
  double lower, upper, initial;
};
constexpr Bounds kBounds[] = {
    {"PDX2", -1.0, 0.0, -0.05}, {"PDY2", -1.0, 0.0, -0.05}, {"QCZ1", 0.6, kMostQCZ1, 1.05}};

const Bounds* bounds_of(std::string_view coefficient) {
  const auto found = std::find_if(std::begin(kBounds), std::end(kBounds), [&](const Bounds& one) {
    return one.coefficient == coefficient;
  });
  return found == std::end(kBounds) ? nullptr : found;
}

}  // namespace

std::string bounded_variables(const std::vector<std::string>& coefficients) {
  std::string text;
  for (const std::string& name : coefficients)
    if (const Bounds* bounds = bounds_of(name))
      text += fmt::format(
          "variable.{0} = {{path = \"{0}\", lower = {1}, upper = {2}, initial = {3}}}\n",
          name,
          bounds->lower,
          bounds->upper,
          bounds->initial);
  if (text.empty()) return text;
  return "# Friction falls with load and the trail stays beyond the data, by these bounds.\n" +
         text;
}

bool is_bounded(std::string_view coefficient) { return bounds_of(coefficient) != nullptr; }

std::vector<std::string> Freed::in_words() const {
  std::vector<std::string> lines;
  for (const auto& [reason, names] : left_out)
    lines.push_back(fmt::format("not freed, {}: {}", reason, fmt::join(names, ", ")));
  return lines;
}

Freed stages_of(const TireTest& t) {
  Freed freed;
  if (t.cornering && t.driving && !t.combined)
    freed.left_out.push_back({fmt::format("because fewer than {} samples have slip and slip angle "
                                          "at once",
                                          kFewestCombined),
                              {"RBX1", "RBX2", "RCX1", "RBY1", "RBY2", "RCY1", "RHY1"}});
  const magic_formula::ConditionLevels of_cornering = t.levels_of(false),
                                       of_driving = t.levels_of(true);
  for (Stage& stage : every_stage_of(t)) {
    const std::string& experiment = stage.experiments.front();
    const bool is_of_driving = experiment == "Fx" || experiment == "Fy_driven" || !t.cornering;
    std::vector<std::string> told;
    for (const std::string& name : stage.coefficients) {
      const std::string reason =
          magic_formula::reason_against(name, is_of_driving ? of_driving : of_cornering);
      if (reason.empty()) {
        told.push_back(name);
        continue;
      }
      const auto known = std::find_if(freed.left_out.begin(),
                                      freed.left_out.end(),
                                      [&](const auto& one) { return one.first == reason; });
      if (known == freed.left_out.end())
        freed.left_out.push_back({reason, {name}});
      else
        known->second.push_back(name);
    }
    stage.coefficients = told;
    if (!told.empty()) freed.stages.push_back(std::move(stage));
  }
  return freed;
}

}  // namespace latsch::cli
