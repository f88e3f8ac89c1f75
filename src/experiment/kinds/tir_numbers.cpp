// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/tir_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/tire/kept_parts.h"
#include "formats/tire/tir_file.h"
#include "models/magic_formula/limits/range_log.h"
#include "models/magic_formula/limits/symmetry.h"
#include "models/magic_formula/standstill.h"

namespace latsch::experiment {
namespace {

using magic_formula::Parameters;
using magic_formula::Version;

}  // namespace

Document read_tir_numbers(const std::filesystem::path& file) {
  return Document::parse(magic_formula::tree_text(formats::read_tir(file).parameters),
                         file.string());
}

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
