// SPDX-License-Identifier: Apache-2.0
#include "measurement/hammer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "numerics/signals/fft.h"
#include "numerics/signals/sample_count.h"

namespace latsch {
namespace {

/// Returns the spectrum of a window after subtracting the mean level before the hit, where there is
/// no response yet.
numerics::Spectrum spectrum(std::span<const double> x, int first, int length, int before) {
  std::vector<double> window(x.begin() + first, x.begin() + first + length);
  const double level =
      before > 0 ? std::accumulate(window.begin(), window.begin() + before, 0.0) / before : 0.0;
  for (double& value : window) value -= level;
  return numerics::real_fft(window, length);
}

}  // namespace

std::vector<int> find_hits(std::span<const double> hammer,
                           double rate,
                           const HammerSettings& settings) {
  std::vector<double> sorted(hammer.begin(), hammer.end());
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double level = sorted[sorted.size() / 2];
  double hardest = 0.0;
  for (const double value : hammer) hardest = std::max(hardest, std::abs(value - level));
  if (hardest == 0.0) throw InputError("the hammer's channel is constant: no hit is in it");
  const int before = numerics::sample_count(settings.before, rate),
            length = numerics::sample_count(settings.window, rate);
  // number of samples after the beginning of a hit within which a value above the threshold belongs
  // to the same hit
  const int contact = std::max(1, before);
  std::vector<int> all;
  for (int i = 0, last = -length; i < static_cast<int>(hammer.size()); ++i) {
    if (std::abs(hammer[i] - level) < settings.threshold * hardest) continue;
    if (i - last > contact) all.push_back(i);
    last = i;
  }
  std::vector<int> hits;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const int first = all[k] - before, end = first + length;
    const bool whole = first >= 0 && end <= static_cast<int>(hammer.size());
    if (whole && (k + 1 == all.size() || all[k + 1] >= end)) hits.push_back(first);
  }
  if (hits.empty()) {
    throw InputError(
        fmt::format("of {} hits of the hammer none has {:g} s for itself: expected "
                    "longer pauses, or a shorter window",
                    all.size(),
                    settings.window));
  }
  return hits;
}

MeasuredResponse hammer_response(std::span<const double> hammer,
                                 std::span<const double> force,
                                 double rate,
                                 const std::vector<int>& hits,
                                 const HammerSettings& settings,
                                 Estimator estimator) {
  assert(hammer.size() == force.size() && !hits.empty());
  const int before = numerics::sample_count(settings.before, rate),
            length = numerics::sample_count(settings.window, rate);
  numerics::Densities sums;
  sums.xx.assign(length / 2 + 1, 0.0);
  sums.yy = sums.xx;
  sums.xy.assign(length / 2 + 1, 0.0);
  for (const int first : hits) {
    const auto X = spectrum(hammer, first, length, before);
    const auto Y = spectrum(force, first, length, before);
    for (std::size_t k = 0; k < X.size(); ++k) {
      sums.xx[k] += std::norm(X[k]);
      sums.yy[k] += std::norm(Y[k]);
      sums.xy[k] += std::conj(X[k]) * Y[k];
    }
  }
  MeasuredResponse response;
  for (int k = 0; k <= length / 2; ++k) response.frequency.push_back(k * rate / length);
  response.H = estimator == Estimator::h1 ? response_h1(sums) : response_h2(sums);
  response.coherence = coherence(sums);
  response.hits = static_cast<int>(hits.size());
  return response;
}

}  // namespace latsch
