// SPDX-License-Identifier: Apache-2.0
#include "extrapolated_slope.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace latsch::benchmarks {
namespace {

constexpr std::size_t kFewest = 3;  // steps

struct Difference {
  double step, value, noise;
};

/// The best of the table that begins with `row` and goes on with powers `power`, 2 `power`, ...
ExtrapolatedSlope best(const std::vector<Difference>& differences, int power) {
  ExtrapolatedSlope found{0.0, std::numeric_limits<double>::infinity()};
  std::vector<Difference> before;
  for (std::size_t k = 0; k < differences.size(); ++k) {
    std::vector<Difference> row = {differences[k]};
    for (std::size_t j = 1; j <= k; ++j) {
      const double ratio = std::pow(differences[k - j].step / differences[k].step, power);
      const Difference &left = row[j - 1], &above = before[j - 1];
      const double value = left.value + (left.value - above.value) / (ratio - 1.0);
      const double noise = (ratio * left.noise + above.noise) / (ratio - 1.0);
      const double distance = std::max(std::abs(value - left.value), std::abs(value - above.value));
      const double error = std::max(distance, noise);
      if (error < found.error) {
        found.value = value;
        found.error = error;
      }
      row.push_back({differences[k].step, value, noise});
    }
    before = std::move(row);
  }
  return found;
}

}  // namespace

std::optional<ExtrapolatedSlope> extrapolated_slope(const std::vector<StepValues>& steps,
                                                    double at,
                                                    double noise) {
  std::vector<Difference> central, backward, forward;
  for (const auto& [h, below, above] : steps) {
    if (below && above) central.push_back({h, (*above - *below) / (2.0 * h), noise / h});
    if (below) backward.push_back({h, (at - *below) / h, 2.0 * noise / h});
    if (above) forward.push_back({h, (*above - at) / h, 2.0 * noise / h});
  }
  if (central.size() >= kFewest) return best(central, 2);
  auto& side = backward.size() > forward.size() ? backward : forward;
  if (side.size() < kFewest) return std::nullopt;
  ExtrapolatedSlope found = best(side, 1);
  found.one_sided = true;
  return found;
}

}  // namespace latsch::benchmarks
