// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/fitted_tir.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "experiment/kinds/tir_numbers.h"
#include "experiment/rigs/slip/condition_levels.h"
#include "formats/tire/tir_file.h"

namespace latsch::experiment {
namespace {

using formats::TirRemarks;
using magic_formula::Parameters;

/// An input of the tire, with the keys of its validity limits in the file.
struct LimitedInput {
  const char *condition, *words, *section, *lower, *upper;
  const char* unit;
  double size;  // SI value of one unit
  // SI; values with a smaller spread are scatter about one value; 0: the number of levels decides
  double least_spread;
};

constexpr double kRadPerDegree = std::numbers::pi / 180.0;
constexpr LimitedInput kInputs[] = {
    {"kappa", "longitudinal slip", "LONG_SLIP_RANGE", "KPUMIN", "KPUMAX", "", 1.0, 0.04},
    {"alpha",
     "slip angle",
     "SLIP_ANGLE_RANGE",
     "ALPMIN",
     "ALPMAX",
     " deg",
     kRadPerDegree,
     kRadPerDegree},
    {"gamma", "camber", "INCLINATION_ANGLE_RANGE", "CAMMIN", "CAMMAX", " deg", kRadPerDegree, 0.0},
    {"Fz", "load", "VERTICAL_FORCE_RANGE", "FZMIN", "FZMAX", " N", 1.0, 0.0},
    {"p", "pressure", "INFLATION_PRESSURE_RANGE", "PRESMIN", "PRESMAX", " kPa", 1e3, 0.0}};

struct MeasuredExtent {
  double least, greatest;
  bool varies;
};

std::size_t level_count_of(const std::string& condition, const std::vector<double>& values) {
  const auto levels = condition_levels([&](const std::string& channel) {
    return channel == condition ? values : std::vector<double>{};
  });
  for (const auto one : {magic_formula::Condition::load,
                         magic_formula::Condition::camber,
                         magic_formula::Condition::pressure,
                         magic_formula::Condition::speed})
    if (magic_formula::channel_of(one) == condition)
      return static_cast<std::size_t>(levels[static_cast<std::size_t>(one)].count);
  return 0;
}

/// Returns the range of the input in the fitted tests; nullopt if no such test states the
/// condition.
std::optional<MeasuredExtent> measured_extent_of(const LimitedInput& input,
                                                 const MeasuredAt& measured_at) {
  std::vector<double> values = measured_at(input.condition);
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return std::nullopt;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const bool varies = input.least_spread > 0.0 ? *greatest - *least > input.least_spread
                                               : level_count_of(input.condition, values) > 1;
  return MeasuredExtent{*least, *greatest, varies};
}

std::string span_in_words(const LimitedInput& input, const MeasuredExtent& extent) {
  return fmt::format("{:.4g} to {:.4g}{}",
                     extent.least / input.size + 0.0,
                     extent.greatest / input.size + 0.0,
                     input.unit);
}

/// Sets the limits of one input and records the reason.
void limit_input(const LimitedInput& input,
                 const MeasuredAt& measured_at,
                 Parameters& p,
                 TirRemarks& remarks) {
  const auto extent = measured_extent_of(input, measured_at);
  if (!extent) {
    remarks.of_sections[input.section] =
        fmt::format("no range from the data: they do not state the {}", input.words);
    return;
  }
  if (!extent->varies) {
    remarks.of_sections[input.section] = fmt::format(
        "no range from the data: they have only one {}, {}, and do not determine what depends on "
        "it",
        input.words,
        span_in_words(input, *extent));
    return;
  }
  remarks.of_sections[input.section] = fmt::format(
      "{} of the data: {}, without a margin", input.words, span_in_words(input, *extent));
  double& lower = p.*magic_formula::find_parameter(input.lower)->member;
  double& upper = p.*magic_formula::find_parameter(input.upper)->member;
  // Loads at or below zero are not counted; a lower limit of 0 means none.
  const double least =
      input.condition == std::string("Fz") ? std::max(0.0, extent->least) : extent->least;
  const auto take = [&](double& limit, double data, bool is_inside, const char* key) {
    const bool is_kept = is_inside;
    if (!is_kept) limit = data;
    remarks.of_keys[key] = is_kept ? "limit of the model file, which held in the fit: the data go "
                                     "beyond it"
                                   : "from the data";
  };
  take(lower, least, lower > least, input.lower);
  take(upper, extent->greatest, upper < extent->greatest, input.upper);
}

/// Adds a remark with the measured speeds, because a .tir has no range of speed.
void remark_speed(const MeasuredAt& measured_at, TirRemarks& remarks) {
  std::vector<double> values = measured_at("Vx");
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  remarks.of_sections["MODEL"] = fmt::format(
      "speeds of the data: {:.4g} to {:.4g} m/s; a .tir has no range of speed", *least, *greatest);
}

/// Returns the origin of a value that the study has not fitted; `stated` contains the remarks of
/// the model's file.
std::string origin_of(const std::string& key,
                      const std::map<std::string, std::string, std::less<>>& stated,
                      const std::string& file) {
  const auto found = stated.find(key);
  if (found == stated.end()) return "assumed, default of Latsch";
  if (found->second.starts_with("assumed")) return found->second;
  return "kept from " + file + (found->second.empty() ? "" : ": " + found->second);
}

}  // namespace

std::set<std::string> known_coefficients(const std::filesystem::path& model_file,
                                         const std::vector<std::string>& fitted) {
  std::set<std::string> known(fitted.begin(), fitted.end());
  try {
    for (const auto& [key, remark] : formats::remarks_of(formats::read_tir(model_file)))
      if (!remark.starts_with("assumed")) known.insert(key);
  } catch (const InputError&) {  // the file was moved or deleted since the study was read
  }
  return known;
}

std::string fitted_tir_text(const Document& numbers, const Provenance& provenance) {
  Parameters p = parameters_of(numbers);
  TirRemarks remarks;
  std::map<std::string, std::string, std::less<>> stated;
  std::vector<std::string> header = provenance.header;
  header.push_back(
      "Behind each value: fitted (by this study), kept from the model file, or assumed. "
      "A coefficient that is not listed is 0: assumed.");
  const std::string name = on_one_line(provenance.model_name);
  try {
    const formats::TirFile tir = formats::read_tir(provenance.model_file);
    stated = formats::remarks_of(tir);
  } catch (const InputError& error) {  // the file was moved or deleted since the study was read
    header.push_back(std::string("The model file cannot be read any more: ") + error.what());
  }
  remarks.header = comment_lines(header, "$ ");
  for (const char* word : {"FITTYP", "TYRESIDE", "USE_MODE"})
    remarks.of_keys[word] = origin_of(word, stated, name);
  for (const auto& field : magic_formula::parameter_fields()) {
    const std::string key(field.name);
    const auto fitted = provenance.origins.find(key);
    const bool is_written = p.*field.member != field.fallback ||
                            fitted != provenance.origins.end() ||
                            formats::is_always_written(field, p.version);
    if (!is_written) continue;
    remarks.of_keys[key] = on_one_line(
        fitted != provenance.origins.end() ? fitted->second : origin_of(key, stated, name));
  }
  if (provenance.measured_at && !provenance.measured_at("Fz").empty()) {
    for (const LimitedInput& input : kInputs)
      limit_input(input, provenance.measured_at, p, remarks);
    remark_speed(provenance.measured_at, remarks);
  }
  return with_parts_of(provenance.model_file, formats::tir_text(p, remarks));
}

}  // namespace latsch::experiment
