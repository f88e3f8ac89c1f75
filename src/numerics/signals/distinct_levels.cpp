// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/distinct_levels.h"

#include <algorithm>
#include <cmath>

namespace latsch::numerics {
namespace {

// Smallest share of the samples that makes a level; a peak with fewer is a transition between
// levels.
constexpr double kLeastShare = 0.015;
// Ratio of the density in a valley to that of the lower peak beside it, above which the valley does
// not separate two levels.
constexpr double kValley = 0.35;
// Spacing of the points of the density, as a share of the kernel's width.
constexpr double kStep = 0.25;
// Distance, in kernel widths, beyond which a sample adds nothing to the density.
constexpr double kReach = 4.0;
// Largest number of kernel widths in the span of the values. A wider span is not resolved more
// finely.
constexpr double kMostKernels = 50'000;
// Share of a level's samples on either side that may be outliers.
constexpr double kTail = 0.02;

/// Returns the density of the ascending `values` at `points` positions: `first`, first + step, ....
/// `h` is the width of the kernel.
std::vector<double> density(
    const std::vector<double>& values, double first, double step, std::size_t points, double h) {
  std::vector<double> sum(points, 0.0);
  for (const double x : values) {
    const auto from =
        static_cast<std::size_t>(std::max(0.0, std::ceil((x - kReach * h - first) / step)));
    for (std::size_t k = from; k < points; ++k) {
      const double z = (first + step * static_cast<double>(k) - x) / h;
      if (z > kReach) break;
      sum[k] += std::exp(-0.5 * z * z);
    }
  }
  return sum;
}

/// Returns the positions of the valleys that separate two levels.
std::vector<std::size_t> valleys(const std::vector<double>& f) {
  std::vector<std::size_t> found;
  std::size_t lowest = 0;  // index of the lowest density since the peak of this level
  double peak = 0.0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (f[k] < f[lowest]) lowest = k;
    if (f[lowest] < kValley * std::min(peak, f[k]) && lowest > 0) {
      found.push_back(lowest);
      peak = f[k];
      lowest = k;
    } else if (f[k] >= peak) {
      peak = f[k];
      lowest = k;
    }
  }
  return found;
}

}  // namespace

DistinctLevels distinct_levels(std::vector<double> values, const LevelResolution& resolution) {
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  DistinctLevels levels;
  if (values.empty()) return levels;
  std::sort(values.begin(), values.end());
  const double span = values.back() - values.front();
  const double h = std::max(resolution.kernel, span / kMostKernels);
  const double first = values.front() - kReach * h;
  const auto points = static_cast<std::size_t>((span + 2.0 * kReach * h) / (kStep * h)) + 1;
  const std::vector<double> f = density(values, first, kStep * h, points, h);
  std::vector<double> ends;
  for (const std::size_t k : valleys(f)) ends.push_back(first + kStep * h * double(k));
  ends.push_back(values.back());
  auto begin = values.begin();
  for (const double end : ends) {
    const auto to = std::upper_bound(begin, values.end(), end);
    const auto count = to - begin;
    if (static_cast<double>(count) >= kLeastShare * static_cast<double>(values.size())) {
      const auto tail = static_cast<std::ptrdiff_t>(kTail * static_cast<double>(count));
      levels.values.push_back(*(begin + count / 2));
      if (*(to - 1 - tail) - *(begin + tail) > resolution.swept) levels.is_swept = true;
    }
    begin = to;
  }
  return levels;
}

}  // namespace latsch::numerics
