// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/tir_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "base/units.h"
#include "formats/tire/kept_parts.h"
#include "formats/tire/tir_file.h"
#include "models/magic_formula/limits/symmetry.h"
#include "models/magic_formula/standstill.h"

namespace latsch::experiment {
namespace {

using magic_formula::MeasuredSide;
using magic_formula::Parameters;
using magic_formula::ParameterUnit;
using magic_formula::Version;

const char* si_unit_of(ParameterUnit unit) {
  switch (unit) {
    case ParameterUnit::one:
      return "1";
    case ParameterUnit::length:
      return "m";
    case ParameterUnit::force:
      return "N";
    case ParameterUnit::angle:
      return "rad";
    case ParameterUnit::mass:
      return "kg";
    case ParameterUnit::time:
      return "s";
    case ParameterUnit::pressure:
      return "Pa";
    case ParameterUnit::velocity:
      return "m/s";
    case ParameterUnit::acceleration:
      return "m/s^2";
    case ParameterUnit::stiffness:
      return "N/m";
    case ParameterUnit::torsional_stiffness:
      return "N m/rad";
    case ParameterUnit::damping:
      return "N s/m";
    case ParameterUnit::inertia:
      return "kg m^2";
    case ParameterUnit::frequency:
      return "Hz";
  }
  return "1";
}

constexpr const char* kVersions[] = {"5.2", "6.1", "6.2"};
constexpr const char* kSides[] = {"left", "right", "symmetric"};

int index_of(const Node& root, const char* key, std::initializer_list<const char*> names) {
  const std::string chosen = root.choice(key, {names.begin(), names.end()});
  int i = 0;
  for (const char* name : names) {
    if (chosen == name) return i;
    ++i;
  }
  return 0;
}

std::string list(const std::vector<double>& values, const char* unit) {
  return fmt::format("{{unit = \"{}\", values = [{}]}}", unit, fmt::join(values, ", "));
}

}  // namespace

std::vector<std::string> tir_notes(const std::filesystem::path& file) {
  formats::TirFile tir = formats::read_tir(file);
  if (const auto* model = tir.source.find("MODEL"); model && !model->find("TYRESIDE"))
    tir.notes.push_back(
        fmt::format("{}: [MODEL] states no TYRESIDE: it is assumed to be a tire of the left side "
                    "(LEFT); a car puts "
                    "its mirror image on the right",
                    file.string()));
  const auto asymmetric = magic_formula::asymmetric_coefficients(tir.parameters);
  if (tir.parameters.side == magic_formula::MeasuredSide::symmetric && !asymmetric.empty())
    tir.notes.push_back(
        fmt::format("{}: TYRESIDE is SYMMETRIC, but {} {} not 0, so that the tire differs from its "
                    "mirror image: they count, and a car has the tire on the left and its mirror "
                    "image on the right. State the side, or set them to 0",
                    file.string(),
                    fmt::join(asymmetric, ", "),
                    asymmetric.size() == 1 ? "is" : "are"));
  return std::move(tir.notes);
}

std::string side_in_words(const Document& numbers) {
  const Node root = numbers.root();
  const std::string side = root.has("side") ? root.text("side") : "left";
  return side == "symmetric" ? "symmetric, used on a car as a left one"
                             : "of the " + side + " side";
}

Document read_tir_numbers(const std::filesystem::path& file) {
  const Parameters p = formats::read_tir(file).parameters;
  std::string text = fmt::format("formula = \"{}\"\nside = \"{}\"\nuse_mode = {}\n",
                                 kVersions[static_cast<int>(p.version)],
                                 kSides[static_cast<int>(p.side)],
                                 p.use_mode);
  if (!p.curve_deflection.empty()) {
    text += "curve_deflection = " + list(p.curve_deflection, "m") + "\n";
    text += "curve_force = " + list(p.curve_force, "N") + "\n";
  }
  for (const auto& field : magic_formula::parameter_fields()) {
    const double value = p.*field.member;
    if (!std::isfinite(value)) continue;  // a range without an end is not stored
    const bool plain = field.unit == ParameterUnit::one;
    text += plain ? fmt::format("{} = {}\n", field.name, value)
                  : fmt::format("{} = \"{} {}\"\n", field.name, value, si_unit_of(field.unit));
  }
  return Document::parse(text, file.string());
}

magic_formula::Parameters parameters_of(const Document& numbers) {
  const Node root = numbers.root();
  Parameters p;
  p.version = static_cast<Version>(index_of(root, "formula", {"5.2", "6.1", "6.2"}));
  p.side = static_cast<MeasuredSide>(index_of(root, "side", {"left", "right", "symmetric"}));
  p.use_mode = static_cast<int>(root.integer("use_mode", -1'000'000, 1'000'000));
  if (root.has("curve_deflection")) {
    p.curve_deflection = root.quantities("curve_deflection", "m");
    p.curve_force = root.quantities("curve_force", "N");
  }
  for (const auto& field : magic_formula::parameter_fields()) {
    const bool needed = field.name == "UNLOADED_RADIUS" || field.name == "FNOMIN" ||
                        field.name == "VERTICAL_STIFFNESS" || field.name == "NOMPRES" ||
                        field.name == "LONGVL";
    const Range range = needed                  ? Range::positive()
                        : field.name == "VXLOW" ? Range::not_negative()
                                                : Range{};
    if (root.has(field.name)) {
      p.*field.member = root.quantity(field.name, si_unit_of(field.unit), range);
    }
  }
  return p;
}

std::optional<double> section_height_of(const Parameters& p) {
  if (!(p.RIM_RADIUS > 0.0 && p.RIM_RADIUS < p.UNLOADED_RADIUS)) return std::nullopt;
  return p.UNLOADED_RADIUS - p.RIM_RADIUS;
}

std::optional<double> tread_half_width_of(const Parameters& p) {
  return p.WIDTH > 0.0 ? std::optional(0.5 * p.WIDTH) : std::nullopt;
}

std::optional<SpecimenKind::Size> tir_size(const Document& numbers) {
  const Parameters p = parameters_of(numbers);
  const auto height = section_height_of(p);
  if (!height) return std::nullopt;
  return SpecimenKind::Size{p.UNLOADED_RADIUS, *height};
}

std::string no_pressure_in_words() {
  return "the tire's file has no coefficient of the pressure (PFZ1, PPX1 to PPX4, PPY1 to PPY5, "
         "PPZ1, PPZ2 ... are 0), so its forces are those at its own pressure";
}

std::vector<std::string> limits_met_by(const Parameters& parameters,
                                       const magic_formula::RangeLog& log,
                                       const Inflation& asked_pressure) {
  auto sentences = magic_formula::ranges_left(log.inputs(), parameters);
  // At rest and below VXLOW the tire also depends on values that the file does not state.
  const auto speed = log.inputs().speed;
  if (speed.to > 0.0 && speed.from < magic_formula::low_speed(parameters))
    for (const std::string& assumed : magic_formula::assumed_at_standstill(parameters))
      sentences.push_back("assumed for the wheel that hardly rolls in this test: " + assumed);
  constexpr double kRounding = 1e-9;
  const double own = parameters.INFLPRES;
  if (asked_pressure && std::abs(*asked_pressure - own) > kRounding * own &&
      !magic_formula::pressure_acts(parameters))
    sentences.push_back("the pressure of the test has no effect: " + no_pressure_in_words());
  return sentences;
}

std::vector<std::string> limits_when_driven_of(const Parameters& parameters,
                                               const DrivenWheel& driven) {
  magic_formula::InputExtremes inputs;
  const std::pair<const char*, magic_formula::Extremes*> quantities[] = {{"Fz", &inputs.Fz},
                                                                         {"kappa", &inputs.kappa},
                                                                         {"alpha", &inputs.alpha},
                                                                         {"gamma", &inputs.gamma},
                                                                         {"p", &inputs.p},
                                                                         {"speed", &inputs.speed}};
  for (const auto& [name, extremes] : quantities)
    if (const auto found = driven.find(name); found != driven.end()) {
      extremes->add(found->second.first);
      extremes->add(found->second.second);
    }
  return magic_formula::ranges_left(inputs, parameters);
}

void refuse_soft_pressure(const Parameters& p, double pressure, const Place& place) {
  const double factor = 1.0 + p.PFZ1 * (pressure / p.NOMPRES - 1.0);
  if (p.PFZ1 == 0.0 || factor > 0.0) return;
  throw InputError(
      place,
      fmt::format("the tire has no vertical stiffness at {}: its factor 1 + PFZ1 dpi is {:.3g}, "
                  "with PFZ1 = {:g} and dpi = p / NOMPRES - 1; expected a pressure above {}, or a "
                  "smaller PFZ1",
                  format_quantity(pressure, "kPa", 4),
                  factor,
                  p.PFZ1,
                  format_quantity(p.NOMPRES * (1.0 - 1.0 / p.PFZ1), "kPa", 4)));
}

std::string no_stiffness_of(const Parameters& p, const std::string& direction) {
  const auto at_nominal_load =
      magic_formula::MagicFormula(p).evaluate({p.FNOMIN, 0.0, 0.0, 0.0, 0.0, p.LONGVL, p.INFLPRES});
  const bool mf52 = p.version == Version::mf52;
  if (direction == "longitudinal" && !(at_nominal_load.sigma_x > 0.0))
    return mf52 ? "its relaxation length is 0, because its file has no PTX1"
                : "its file has no LONGITUDINAL_STIFFNESS";
  if (direction == "lateral" && !(at_nominal_load.sigma_y > 0.0))
    return mf52 ? "its relaxation length is 0, because its file has no PTY1 or PTY2"
                : "its file has no LATERAL_STIFFNESS";
  if (direction == "torsional" && !(p.YAW_STIFFNESS > 0.0) &&
      !(magic_formula::pivot_of(p, at_nominal_load).limit > 0.0))
    return "its file has no YAW_STIFFNESS, and no contact patch from which one could be estimated";
  return "";
}

std::string assumed_stiffness_of(const Parameters& p, const std::string& direction) {
  if (direction != "torsional" || p.YAW_STIFFNESS > 0.0) return "";
  return fmt::format("the torsional stiffness is {}",
                     fmt::join(magic_formula::assumed_of_turning(p), "; "));
}

std::vector<std::string> limits_backward_of(const magic_formula::Parameters& p) {
  if (p.PHY1 == 0.0 && p.PHY2 == 0.0 && p.PVY1 == 0.0 && p.PVY2 == 0.0) return {};
  return {
      "a .tir does not say which part of PHY1, PHY2, PVY1 and PVY2 changes sides when the tire "
      "rolls "
      "backward: conicity holds all of the side force at zero slip angle and ply_steer none of it, "
      "so neither is a property of this tire"};
}

std::vector<std::string> upright_footprint(bool rolls) {
  if (rolls) return {};
  return {
      "length and width of the footprint depend on the load alone in a .tir (Q_RA1 .. Q_RB2): at "
      "camber they are those of the upright tire"};
}

std::string tir_text_of(const Document& numbers) {
  return with_parts_of(numbers.file(), formats::tir_text(parameters_of(numbers)));
}

std::string with_parts_of(const std::filesystem::path& file, const std::string& text) {
  if (file.extension() != ".tir" || !std::filesystem::exists(file)) return text;
  try {
    return formats::with_kept_parts(text, formats::read_tir(file));
  } catch (const InputError&) {
    // the file has changed since its numbers were read, so the other parts of its text cannot be
    // kept
    return text;
  }
}

}  // namespace latsch::experiment
