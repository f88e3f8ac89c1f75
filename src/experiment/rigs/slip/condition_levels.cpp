// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/condition_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "numerics/signals/distinct_levels.h"

namespace latsch {
namespace {

using magic_formula::Condition;
using numerics::distinct_levels;
using numerics::DistinctLevels;
using numerics::LevelResolution;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kShown = 8;  // levels named in a message

/// Accuracy with which a rig keeps a condition constant: relative to its value, for camber as an
/// angle.
struct Resolution {
  double kernel, swept;
};
constexpr Resolution kLoad{0.03, 0.5}, kPressure{0.02, 0.25}, kSpeed{0.03, 0.3};
constexpr Resolution kCamber{0.3 * kDegree, 2.5 * kDegree};

struct Shown {
  const char* unit;
  double size;  // SI
};

Shown shown_of(Condition condition) {
  switch (condition) {
    case Condition::load:
      return {"N", 1.0};
    case Condition::camber:
      return {"deg", kDegree};
    case Condition::pressure:
      return {"kPa", 1e3};
    case Condition::speed:
      return {"km/h", 1.0 / 3.6};
  }
  return {"1", 1.0};
}

double size_of(std::vector<double> values) {
  for (double& x : values) x = std::abs(x);
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::lround(0.9 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

LevelResolution resolution_of(Condition condition, double size) {
  switch (condition) {
    case Condition::camber:
      return {kCamber.kernel, kCamber.swept};
    case Condition::load:
      return {kLoad.kernel * size, kLoad.swept * size};
    case Condition::pressure:
      return {kPressure.kernel * size, kPressure.swept * size};
    case Condition::speed:
      return {kSpeed.kernel * size, kSpeed.swept * size};
  }
  return {};
}

std::string in_words(const DistinctLevels& levels, Condition condition) {
  if (levels.is_swept) return "a sweep";
  const auto [unit, size] = shown_of(condition);
  std::string text =
      levels.values.size() == 1 ? "1 level: " : fmt::format("{} levels: ", levels.values.size());
  for (std::size_t k = 0; k < std::min(kShown, levels.values.size()); ++k)
    text += fmt::format("{}{:.3g}", k == 0 ? "" : ", ", levels.values[k] / size + 0.0);
  if (levels.values.size() > kShown) text += " ...";
  return text + " " + unit;
}

magic_formula::LevelsOfCondition levels_of(Condition condition, std::vector<double> values) {
  magic_formula::LevelsOfCondition found;
  const double size = size_of(values);
  const bool is_angle = condition == Condition::camber;
  if (values.empty() || (!is_angle && !(size > 0.0))) return found;
  if (!is_angle)
    for (double& x : values) x = std::abs(x);  // other axes may reverse the sign
  const LevelResolution resolution = resolution_of(condition, size);
  const DistinctLevels levels = distinct_levels(values, resolution);
  found.count = levels.count();
  found.words = in_words(levels, condition);
  if (!levels.values.empty()) {
    const double least = 2.0 * resolution.kernel;
    found.has_both_signs = levels.values.front() < -least && levels.values.back() > least;
  }
  if (is_angle && levels.is_swept) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    found.has_both_signs = *low<-2.0 * kDegree&& * high> 2.0 * kDegree;
  }
  for (double& x : values) x = std::abs(x);
  found.count_of_modulus = distinct_levels(std::move(values), resolution).count();
  return found;
}

}  // namespace

magic_formula::ConditionLevels condition_levels(
    const std::function<std::vector<double>(const std::string&)>& values_of) {
  magic_formula::ConditionLevels all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto condition = static_cast<Condition>(k);
    all[k] = levels_of(condition, values_of(magic_formula::channel_of(condition)));
  }
  return all;
}

std::vector<std::string> reasons_against(
    const std::vector<std::string>& coefficients,
    const std::function<std::vector<double>(const std::string&)>& values_of) {
  const auto levels = condition_levels(values_of);
  std::vector<std::string> reasons;
  for (const std::string& one : coefficients)
    reasons.push_back(magic_formula::reason_against(one, levels));
  return reasons;
}

}  // namespace latsch
