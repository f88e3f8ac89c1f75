// SPDX-License-Identifier: Apache-2.0
#include "measurement/bootstrap.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/random.h"

namespace latsch {

std::vector<double> bootstrap_deviation(
    int hits,
    int draws,
    std::uint64_t seed,
    const std::function<std::vector<double>(const std::vector<int>& chosen)>& result) {
  assert(hits >= 1 && draws >= 2);
  std::vector<std::vector<double>> results;
  for (int draw = 0; draw < draws; ++draw) {
    RandomStream random(seed, draw);
    std::vector<int> chosen(hits);
    for (int& hit : chosen) hit = static_cast<int>(random.below(hits));
    auto values = result(chosen);
    const bool finite =
        std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (finite && (results.empty() || values.size() == results[0].size())) {
      results.push_back(std::move(values));
    }
  }
  if (results.empty()) return {};
  std::vector<double> deviation(results[0].size(), 0.0);
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    double mean = 0.0, sum = 0.0;
    for (const auto& r : results) mean += r[i] / static_cast<double>(results.size());
    for (const auto& r : results) sum += std::pow(r[i] - mean, 2);
    deviation[i] = std::sqrt(sum / std::max(1.0, static_cast<double>(results.size()) - 1.0));
  }
  return deviation;
}

}  // namespace latsch
