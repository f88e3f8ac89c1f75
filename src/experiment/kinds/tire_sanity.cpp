// SPDX-License-Identifier: Apache-2.0
#include "experiment/kinds/tire_sanity.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "experiment/kinds/magic_formula_ranges.h"
#include "experiment/kinds/tir_numbers.h"
#include "models/magic_formula/sanity/sanity.h"

namespace latsch::experiment {
namespace {

/// Returns the range of the values without the lowest 0.5 % and the highest 0.5 %.
std::pair<double, double> reach_of(std::vector<double> values, double otherwise) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return {otherwise, otherwise};
  std::sort(values.begin(), values.end());
  const std::size_t tail = values.size() / 200;
  return {values[tail], values[values.size() - 1 - tail]};
}

/// Returns a narrower range, which becomes the given range again when the check widens it 1.5
/// times.
magic_formula::DataRange narrower(magic_formula::DataRange range) {
  constexpr double kWider = 1.5;  // the factor of models/magic_formula/sanity/sanity.h
  const auto narrow = [](double& from, double& to) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from) / kWider;
    from = middle - half;
    to = middle + half;
  };
  narrow(range.Fz_from, range.Fz_to);
  narrow(range.gamma_from, range.gamma_to);
  narrow(range.p_from, range.p_to);
  range.alpha /= kWider;
  range.kappa /= kWider;
  return range;
}

}  // namespace

std::vector<FaultBeyondData> tire_faults(const Document& numbers, const MeasuredAt& values_of) {
  const magic_formula::Parameters p = parameters_of(numbers);
  magic_formula::DataRange range = range_of(p);
  if (values_of) {
    const std::vector<double> loads = values_of("Fz");
    if (loads.empty()) return {};
    std::tie(range.Fz_from, range.Fz_to) = reach_of(loads, p.FNOMIN);
    range.Fz_from = std::max(range.Fz_from, 1e-3 * p.FNOMIN);
    range.Fz_to = std::max(range.Fz_to, range.Fz_from);
    const auto size = [&](const char* slip) {
      const auto [from, to] = reach_of(values_of(slip), 0.0);
      return std::max(std::abs(from), std::abs(to));
    };
    range.alpha = size("alpha");
    range.kappa = size("kappa");
    std::tie(range.gamma_from, range.gamma_to) = reach_of(values_of("gamma"), 0.0);
    std::tie(range.p_from, range.p_to) = reach_of(values_of("p"), p.INFLPRES);
  }
  std::vector<FaultBeyondData> faults;
  const auto usual = [](std::string_view name) -> std::optional<magic_formula::UsualSpan> {
    const auto range = usual_range_of(name);
    if (!range) return std::nullopt;
    return magic_formula::UsualSpan{range->lower, range->upper};
  };
  const auto found = sanity_faults(p, range, usual);
  const auto within = found.empty() ? found : sanity_faults(p, narrower(range));
  for (const auto& fault : found) {
    const bool is_within =
        std::ranges::any_of(within, [&](const auto& one) { return one.row == fault.row; });
    FaultBeyondData told{(is_within ? "within the data already, " : "") + fault.words, {}};
    for (const std::string& name : fault.coefficients)
      told.numbers.emplace_back(name, p.*magic_formula::find_parameter(name)->member);
    faults.push_back(std::move(told));
  }
  return faults;
}

}  // namespace latsch::experiment
