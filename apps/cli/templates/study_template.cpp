// SPDX-License-Identifier: Apache-2.0
#include "cli/templates/study_template.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "base/text.h"
#include "base/units.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch::cli {
namespace {

constexpr double kWithin =
    4.0;  // Ratio of the upper bound to the tire's own value, and of that value to the lower bound.

constexpr std::string_view kHead =
    R"(# A study: which numbers of tire.toml may vary, what was measured, how the two are compared.
# Quantities carry their units: "2.4 bar", "35 psi", "5 N/mm^2", "22 deg". `latsch check study.toml` reads all of it,
# `latsch help study` tells what else may stand here.
title = "My tire"
model = "tire.toml"

# Any number in tire.toml can vary; `path` says which, `paths = [...]` gives one value to several.
# Logarithmic: a factor is as likely up as down.
)";

constexpr std::string_view kTail = R"(
# Forces at the measured deflections, counted from the first touch of the ground.
[experiment.stiffness]
kind = "load_deflection"
pressure = "{pressure}"
measurement = "stiffness.csv"       # columns deflection (or loaded_radius) and force
compare = "force"                   # or "root_force", which goes with stiffness as a frequency does
exponent = 1                        # k of mean |dF|^k
weight = 1
use = "fit"                         # or "predict": compared in the report only
# noise = "1 %"                     # of a measured value, where known; then of every fitted experiment
deflections = {{unit = "mm", values = [{deflections}]}}  # for `latsch export --measurements` alone

# Modes of the tire on its clamped rim. Unloaded; add deflection = "20 mm" or load = "4 kN" to stand it on the ground.
[experiment.modes]
kind = "modes"
pressure = "{pressure}"
measurement = "modes.csv"           # column frequency; n, type, phase where known
# shapes = "mode_shapes.csv"        # where measured: modes are then paired by MAC
exponent = 1
weight = 1
measured_modes = 10                 # for `latsch export --measurements` alone

[optimizer]
method = "auto"                     # or "residual_trust_region", "gss", "sqp", "nelder_mead", ...
initial_step = 0.2                  # lengths are shares of a variable's range
step_tolerance = 0.005

[doe]                               # for `latsch doe`
design = "full_factorial"           # or "latin_hypercube", "sobol", "morris", with points = 40
levels = 5                          # values of each variable

[run]
workers = 2                         # the result does not depend on it
timeout = "10 min"                  # a trial
)";

std::string modulus(double value) {
  const bool cords = value >= 1e9;
  return format_quantity(value, cords ? "GPa" : "N/mm^2", 3);
}

/// Adds a variable for the parameters at `paths`, if the tire has any of them.
void add(const Document& tire,
         const std::string& name,
         std::vector<std::string> paths,
         double example,
         std::vector<StarterVariable>& variables) {
  if (paths.empty()) return;
  double sum = 0.0;
  for (const std::string& path : paths) sum += std::log(tire.get(path));
  const double initial = std::exp(sum / static_cast<double>(paths.size()));
  variables.push_back({name, std::move(paths), initial, example * initial});
}

std::string text_of(const StarterVariable& variable) {
  std::string text = fmt::format("[variable.{}]\n", variable.name);
  if (variable.paths.size() == 1) {
    text += fmt::format("path = {}\n", in_quotes(variable.paths.front()));
  } else {
    std::string list;
    for (const std::string& path : variable.paths)
      list += (list.empty() ? "" : ", ") + in_quotes(path);
    text += fmt::format("paths = [{}]\n", list);
  }
  return text + fmt::format(
                    "lower = \"{}\"\nupper = \"{}\"\ninitial = \"{}\"\nscale = "
                    "\"logarithmic\"\n\n",
                    modulus(variable.initial / kWithin),
                    modulus(variable.initial * kWithin),
                    modulus(variable.initial));
}

/// Returns the deflections of the study in mm, up to a quarter of the section's height, the usual
/// range of a tire.
std::string deflections_of(const fe_tire::TireDescription& tire) {
  const double height = tire.section.contour.front().r - tire.section.contour.back().r;
  std::string list;
  for (int i = 1; i <= 5; ++i)
    list +=
        fmt::format("{}{:.0f}", i > 1 ? ", " : "", std::round(1e3 * height * (0.04 + 0.04 * i)));
  return list;
}

}  // namespace

std::vector<StarterVariable> starter_variables(const Document& tire) {
  const fe_tire::TireDescription description = fe_tire::read_tire(tire.root());
  std::set<std::string> sidewalls;
  for (const auto& region : description.regions) {
    if (region.name.find("sidewall") == region.name.npos) continue;
    sidewalls.insert(description.rubbers[region.rubber].name);
  }
  std::vector<std::string> rubbers, carcass, belts;
  for (const std::string& name : sidewalls) rubbers.push_back("rubber." + name + ".young_modulus");
  for (const auto& ply : description.plies) {
    const std::string path = "layer." + ply.name + ".young_modulus";
    if (ply.name.starts_with("carcass") || ply.name.starts_with("turnup")) carcass.push_back(path);
    if (ply.name.starts_with("belt")) belts.push_back(path);
  }
  std::vector<StarterVariable> variables;
  const bool whole = sidewalls.size() == 1 && description.rubbers.size() == 1;
  add(tire, whole ? *sidewalls.begin() : "sidewall", rubbers, 1.25, variables);
  add(tire, "carcass", carcass, 0.75, variables);
  add(tire, "belt", belts, 1.3, variables);
  if (variables.empty()) {
    throw InputError(tire.root().place(),
                     "has no region named sidewall and no layer named carcass or belt to vary");
  }
  return variables;
}

std::string study_template(const Document& tire) {
  const auto description = fe_tire::read_tire(tire.root());
  std::string text(kHead);
  for (const StarterVariable& variable : starter_variables(tire)) text += text_of(variable);
  text.pop_back();
  const std::string pressure =
      format_quantity(description.pressure, description.pressure < 1.5e5 ? "kPa" : "bar");
  return text + fmt::format(kTail,
                            fmt::arg("pressure", pressure),
                            fmt::arg("deflections", deflections_of(description)));
}

}  // namespace latsch::cli
