// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/wheel_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

namespace latsch {
namespace {

constexpr double kMostLoad = 1e6;     // N; the largest mining tires carry 1 MN
constexpr double kMostSamples = 0.9;  // share of the samples, as in the checks of other channels

bool is_vertical(const std::string& channel) {
  return channel.size() >= 2 && std::tolower(static_cast<unsigned char>(channel[0])) == 'f' &&
         std::tolower(static_cast<unsigned char>(channel[1])) == 'z';
}

}  // namespace

std::optional<std::string> impossible_load(std::span<const double> values) {
  if (values.empty()) return std::nullopt;
  std::vector<double> sizes;
  for (const double value : values) sizes.push_back(std::abs(value));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  if (*middle <= kMostLoad) return std::nullopt;
  return fmt::format(
      "is {:.4g} kN in the middle of its samples, but no tire carries more than {:.0f} kN: is its "
      "unit right?",
      *middle / 1e3,
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

}  // namespace latsch
