// SPDX-License-Identifier: Apache-2.0
#include "experiment/tests/response_frequencies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/units.h"

namespace latsch::experiment {
namespace {

constexpr long kMostFrequencies = 5000;
constexpr double kSameFrequency = 1e-9;  // relative

std::vector<double> stepped_frequencies(const Node& root) {
  const double from = root.quantity("from", "Hz", Range::positive());
  const double to = root.quantity("to", "Hz", Range::positive());
  const double step = root.quantity("step", "Hz", Range::positive(), 1.0);
  if (to < from) root.reject("to", "is below from, expected a frequency that is not");
  const double count = std::floor((to - from) / step * (1.0 + kSameFrequency)) + 1.0;
  if (count > kMostFrequencies)
    root.reject("step",
                fmt::format("gives {:.0f} frequencies, expected {} at most; state a longer step",
                            count,
                            kMostFrequencies));
  std::vector<double> frequencies;
  for (long k = 0; k < static_cast<long>(count); ++k)
    frequencies.push_back(from + step * static_cast<double>(k));
  return frequencies;
}

std::vector<double> listed_frequencies(const Node& root, const TestSource& source) {
  std::vector<double> frequencies;
  if (const auto from = find_measured(root, "frequencies"))
    frequencies = measured_values(*from, {"frequency", "Hz", true}, source.measured);
  else
    frequencies = root.quantities("frequencies", "Hz", Range::positive());
  if (frequencies.empty() || std::ssize(frequencies) > kMostFrequencies)
    root.reject(
        "frequencies",
        fmt::format("has {} values, expected 1 to {}", frequencies.size(), kMostFrequencies));
  if (std::ranges::adjacent_find(frequencies, std::greater_equal<>()) != frequencies.end())
    root.reject("frequencies", "does not rise from value to value, expected ascending frequencies");
  return frequencies;
}

}  // namespace

std::vector<double> read_frequencies(const Node& root,
                                     const TestSource& source,
                                     double highest,
                                     const char* why) {
  const bool is_listed = find_measured(root, "frequencies") || root.has("frequencies");
  std::vector<double> frequencies =
      is_listed ? listed_frequencies(root, source) : stepped_frequencies(root);
  if (frequencies.back() > highest)
    root.reject(
        is_listed ? "frequencies" : "to",
        fmt::format(
            "reaches {:g} Hz, expected {:g} Hz at most: {}", frequencies.back(), highest, why));
  return frequencies;
}

}  // namespace latsch::experiment
