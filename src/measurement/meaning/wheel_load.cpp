// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/wheel_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

namespace latsch {
namespace {

constexpr double kMostLoad = 1e6;    // N; the largest mining tires carry 1 MN
constexpr double kLeastLoad = 20.0;  // N; a bicycle's wheel carries 100 N and more
// Ratio to the load of a test from which on another unit is more likely than another load; the
// closest two units of a force, N and lbf, differ by 4.4.
constexpr double kOtherUnit = 3.0;
constexpr double kMostSamples = 0.9;  // share of the samples, as in the checks of other channels

bool is_vertical(const std::string& channel) {
  return channel.size() >= 2 && std::tolower(static_cast<unsigned char>(channel[0])) == 'f' &&
         std::tolower(static_cast<unsigned char>(channel[1])) == 'z';
}

/// Returns the median of the moduli of at least one value.
double middle_size(std::span<const double> values) {
  std::vector<double> sizes;
  for (const double value : values) sizes.push_back(std::abs(value));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

/// Returns the unit of which a ratio of numbers to newtons is closest to the given one.
std::string unit_of_ratio(double ratio) {
  struct Unit {
    const char* name;
    double newtons;
  };
  constexpr Unit kUnits[] = {
      {"mN", 1e-3}, {"lbf", 4.4482216}, {"kgf", 9.80665}, {"daN", 10.0}, {"kN", 1e3}, {"MN", 1e6}};
  const Unit* best = &kUnits[0];
  for (const Unit& unit : kUnits)
    if (std::abs(std::log(unit.newtons * ratio)) < std::abs(std::log(best->newtons * ratio)))
      best = &unit;
  return best->name;
}

}  // namespace

std::optional<std::string> impossible_load(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  const double middle = middle_size(values);
  if (middle <= kMostLoad) return std::nullopt;
  return fmt::format(
      "is {:.4g} kN in the middle of its samples, but no tire carries more than {:.0f} kN: is its "
      "unit right?",
      middle / 1e3,
      kMostLoad / 1e3);
}

std::optional<std::string> negative_load(const std::string& channel,
                                         std::span<const double> values) {
  if (!is_vertical(channel) || values.empty()) return std::nullopt;
  const auto below = std::count_if(values.begin(), values.end(), [](double v) { return v < 0.0; });
  if (static_cast<double>(below) < kMostSamples * static_cast<double>(values.size()))
    return std::nullopt;
  return fmt::format(
      "is below 0 in {} of {} samples, but the load on a tire is above 0 in iso axes: is it "
      "recorded in axes of SAE J670?",
      below,
      values.size());
}

std::optional<std::string> unlike_load(const std::string& channel,
                                       std::span<const double> values,
                                       std::optional<double> load) {
  if (!is_vertical(channel) || values.empty()) return std::nullopt;
  const auto above = std::count_if(values.begin(), values.end(), [](double v) { return v > 0.0; });
  if (static_cast<double>(above) < kMostSamples * static_cast<double>(values.size()))
    return std::nullopt;
  const double middle = middle_size(values);
  if (!load) {
    if (middle >= kLeastLoad) return std::nullopt;
    return fmt::format(
        "is {:.4g} N in the middle of its samples, less than any tire carries: is it in kN?",
        middle);
  }
  const double ratio = middle / *load;
  if (ratio < kOtherUnit && ratio > 1.0 / kOtherUnit) return std::nullopt;
  return fmt::format(
      "is {:.4g} N in the middle of its samples, but the load of the test is {:.4g} N: is it in "
      "{}, or is it of another test?",
      middle,
      *load,
      unit_of_ratio(ratio));
}

}  // namespace latsch
