// SPDX-License-Identifier: Apache-2.0
#include "measurement/passages.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numeric>

#include "numerics/signals/butterworth.h"
#include "numerics/signals/fft.h"
#include "numerics/signals/time_delay.h"

namespace latsch {
namespace {

// Least autocorrelation at a period; noise alone reaches 4 / sqrt(samples).
constexpr double kLeastStrength = 0.25;
// share of the highest peak of the autocorrelation that all earlier peaks at equal distances must
// reach
constexpr double kComb = 0.8;

double mean(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

std::vector<double> without_mean(std::vector<double> x) {
  const double level = mean(x);
  for (double& value : x) value -= level;
  return x;
}

/// Returns the autocorrelation R for each lag, divided by the number of overlapping samples and by
/// R(0).
std::vector<double> strengths(const std::vector<double>& x, int lags) {
  std::vector<double> r = numerics::autocorrelation(x, lags);
  const double n = static_cast<double>(x.size()), whole = r[0] / n;
  for (int lag = 0; lag < lags; ++lag) r[lag] = whole > 0.0 ? r[lag] / (n - lag) / whole : 0.0;
  return r;
}

/// Returns the highest value within a hundredth of the lag (plus two samples).
double peak_near(const std::vector<double>& r, double lag) {
  const int reach = 2 + static_cast<int>(lag / 100.0);
  const int lower = std::max(0, static_cast<int>(lag) - reach);
  const int upper = std::min(static_cast<int>(r.size()) - 1, static_cast<int>(lag) + reach);
  return *std::max_element(r.begin() + lower, r.begin() + upper + 1);
}

/// Returns the largest number of equal parts into which a lag can be divided so that the
/// autocorrelation is high at the end of every part. A ringing resonance also has a high
/// autocorrelation after one of its own periods, but not after all of them.
int parts_of(const std::vector<double>& r, int lag, double shortest) {
  const int most = static_cast<int>(lag / shortest);
  for (int parts = most; parts >= 2; --parts) {
    bool all = true;
    for (int k = 1; k < parts && all; ++k) {
      all = peak_near(r, static_cast<double>(k) * lag / parts) >= kComb * r[lag];
    }
    if (all) return parts;
  }
  return 1;
}

/// Returns the position within a period at which the average over all periods is farthest from its
/// mean.
int place_of_hit(std::span<const double> x, double period) {
  const int length = static_cast<int>(period);
  std::vector<double> folded(length, 0.0);
  for (double start = 0.0; start + period < static_cast<double>(x.size()); start += period) {
    const auto first = static_cast<std::size_t>(std::lround(start));
    for (int i = 0; i < length && first + i < x.size(); ++i) folded[i] += x[first + i];
  }
  folded = without_mean(std::move(folded));
  const auto hit = std::max_element(
      folded.begin(), folded.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return static_cast<int>(hit - folded.begin());
}

/// Shifts the start of a passage to the time at which the passage is most similar to the reference.
/// A second alignment from there includes samples that the first window cut off at its ends.
numerics::Delay align(std::span<const double> x,
                      const std::vector<double>& reference,
                      double& start,
                      int most,
                      bool whole_samples) {
  const int length = static_cast<int>(reference.size());
  numerics::Delay delay;
  for (int look = 0; look < 3; ++look) {
    const auto values = without_mean(numerics::values_between(x, start, length));
    const int reach = look == 0 ? most : 2;
    delay = numerics::delay_between(reference, values, -reach, reach);
    start += whole_samples ? std::round(delay.samples) : delay.samples;
  }
  return delay;
}

/// Returns the signal low-passed at `align_below`; the signal itself if that frequency is too high
/// to matter.
std::vector<double> what_is_aligned(std::span<const double> x,
                                    double rate,
                                    const PassageSettings& settings) {
  constexpr int kOrder = 4;
  constexpr double kNoLimit = 0.45;  // share of the sampling rate
  if (settings.align_below > 0.0 && settings.align_below < kNoLimit * rate) {
    const auto sections = numerics::sections_of(numerics::butterworth(
        kOrder, numerics::FilterBand::low_pass, {settings.align_below}, rate));
    if (static_cast<int>(x.size()) > numerics::forward_backward_padding(sections)) {
      return numerics::filter_forward_backward(sections, x);
    }
  }
  return {x.begin(), x.end()};
}

/// Aligns all passages of the signal x once with the reference; `first` is the start of the first
/// passage.
Passages aligned(std::span<const double> x,
                 const std::vector<double>& reference,
                 double first,
                 double period,
                 const PassageSettings& settings) {
  Passages passages;
  passages.period = period;
  passages.length = static_cast<int>(reference.size());
  const int most = std::max(2, static_cast<int>(settings.most_shift * period));
  const double room = numerics::kInterpolationReach;
  const double last = static_cast<double>(x.size()) - passages.length - room;
  for (double next = first; next <= last; next += period) {
    double start = next;
    const auto delay = align(x, reference, start, most, settings.whole_samples);
    if (start < 0.0 || start > last) continue;
    if (delay.likeness < settings.least_likeness) {
      ++passages.left_out;
      continue;
    }
    passages.starts.push_back(start);
    passages.likeness.push_back(delay.likeness);
    next = start;
  }
  return passages;
}

}  // namespace

std::optional<Period> find_period(std::span<const double> signal, double shortest, double longest) {
  const std::vector<double> x = without_mean({signal.begin(), signal.end()});
  const int lags =
      std::min(static_cast<int>(longest) + 3, static_cast<int>(static_cast<double>(x.size()) / 2));
  const int from = std::max(2, static_cast<int>(std::ceil(shortest)));
  if (lags - 2 <= from) return std::nullopt;
  const std::vector<double> r = strengths(x, lags);
  int best = -1;
  for (int lag = from; lag + 1 < lags; ++lag) {
    const bool peak = r[lag] >= r[lag - 1] && r[lag] >= r[lag + 1];
    if (peak && (best < 0 || r[lag] > r[best])) best = lag;
  }
  if (best < 0 || r[best] < kLeastStrength) return std::nullopt;
  const double guess = static_cast<double>(best) / parts_of(r, best, from);
  const int near = static_cast<int>(std::lround(guess));
  const int reach = 2 + near / 100;
  const auto delay = numerics::delay_between(
      x, x, std::max(1, near - reach), std::min(near + reach, static_cast<int>(x.size()) - 1));
  return Period{delay.samples, peak_near(r, delay.samples)};
}

Passages find_passages(std::span<const double> signal,
                       double rate,
                       double period,
                       const PassageSettings& settings) {
  assert(period >= 4.0);
  const std::vector<double> x = what_is_aligned(signal, rate, settings);
  const int length = static_cast<int>(period);
  double first = place_of_hit(x, period) - settings.hit_at * period;
  while (first < numerics::kInterpolationReach) first += period;
  first = std::round(first);
  Passages passages;
  passages.period = period;
  passages.length = length;
  if (first + length + numerics::kInterpolationReach > static_cast<double>(x.size())) {
    return passages;
  }
  const auto reference = without_mean(passage_values(x, first, length));
  passages = aligned(x, reference, first, period, settings);
  if (settings.align_to_average && passages.starts.size() > 1) {
    const auto mean = average(cut(x, passages)).mean;
    passages = aligned(x, without_mean(mean), passages.starts.front(), period, settings);
  }
  if (passages.starts.size() < 2) passages.starts.clear(), passages.likeness.clear();
  return passages;
}

std::vector<double> passage_values(std::span<const double> x, double start, int length) {
  return numerics::values_between(x, start, length);
}

std::vector<std::vector<double>> cut(std::span<const double> x, const Passages& passages) {
  std::vector<std::vector<double>> rows;
  for (const double start : passages.starts) {
    rows.push_back(passage_values(x, start, passages.length));
  }
  return rows;
}

PassageAverage average(const std::vector<std::vector<double>>& passages) {
  assert(!passages.empty());
  const std::size_t length = passages[0].size();
  const double count = static_cast<double>(passages.size());
  PassageAverage result;
  result.mean.assign(length, 0.0);
  result.spread.assign(length, 0.0);
  for (const auto& passage : passages) {
    for (std::size_t i = 0; i < length; ++i) result.mean[i] += passage[i] / count;
  }
  for (const auto& passage : passages) {
    for (std::size_t i = 0; i < length; ++i) {
      result.spread[i] += std::pow(passage[i] - result.mean[i], 2);
    }
  }
  for (double& s : result.spread) s = std::sqrt(s / std::max(1.0, count - 1.0));
  return result;
}

Coherence ensemble_coherence(const std::vector<std::vector<double>>& passages, double rate) {
  assert(!passages.empty());
  const int length = numerics::fast_length(static_cast<int>(passages[0].size()));
  numerics::Spectrum sum(length / 2 + 1, 0.0);
  std::vector<double> power(length / 2 + 1, 0.0);
  for (const auto& passage : passages) {
    const auto X = numerics::real_fft(without_mean(passage), length);
    for (std::size_t k = 0; k < X.size(); ++k) sum[k] += X[k], power[k] += std::norm(X[k]);
  }
  Coherence coherence;
  for (std::size_t k = 0; k < sum.size(); ++k) {
    coherence.frequency.push_back(static_cast<double>(k) * rate / length);
    const double count = static_cast<double>(passages.size());
    coherence.value.push_back(power[k] > 0.0 ? std::norm(sum[k]) / count / power[k] : 0.0);
  }
  return coherence;
}

std::vector<double> mean_of(const std::vector<std::vector<double>>& passages,
                            const std::vector<int>& chosen) {
  assert(!chosen.empty());
  std::vector<double> mean(passages[0].size(), 0.0);
  for (const int k : chosen) {
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += passages[k][i];
  }
  for (double& value : mean) value /= static_cast<double>(chosen.size());
  return mean;
}

}  // namespace latsch
