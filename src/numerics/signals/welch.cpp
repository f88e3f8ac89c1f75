// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/welch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "numerics/signals/fft.h"

namespace latsch::numerics {
namespace {

double mean(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

int power_of_two(double at_least) {
  int n = 1;
  while (n < at_least) n *= 2;
  return n;
}

/// Subtracts the least-squares line through the samples.
void remove_line(std::vector<double>& x) {
  const double center = (static_cast<double>(x.size()) - 1.0) / 2.0, level = mean(x);
  double slope = 0.0, square = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double t = static_cast<double>(i) - center;
    slope += t * x[i];
    square += t * t;
  }
  if (square > 0.0) slope /= square;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] -= level + slope * (static_cast<double>(i) - center);
  }
}

/// Transforms of the windowed segments of one record.
class Segments {
 public:
  Segments(std::span<const double> x, const WelchSettings& settings)
      : x_(x), settings_(settings), window_(window_values(settings.window, settings.segment)) {
    if (settings.detrend == Detrend::record_mean) level_ = mean(x);
  }

  Spectrum operator()(int k) const {
    const auto first = static_cast<std::size_t>(k) * (settings_.segment - settings_.overlap);
    const auto part = x_.subspan(first, settings_.segment);
    std::vector<double> segment(part.begin(), part.end());
    const double level = settings_.detrend == Detrend::segment_mean ? mean(segment) : level_;
    if (settings_.detrend == Detrend::segment_line) remove_line(segment);
    for (std::size_t i = 0; i < segment.size(); ++i) {
      segment[i] = (segment[i] - level) * window_[i];
    }
    return real_fft(segment, settings_.length);
  }

  double window_power() const {
    return std::inner_product(window_.begin(), window_.end(), window_.begin(), 0.0);
  }

 private:
  std::span<const double> x_;
  WelchSettings settings_;
  std::vector<double> window_;
  double level_ = 0.0;
};

void check(std::size_t samples, const WelchSettings& s) {
  assert(s.segment >= 2 && s.overlap >= 0 && s.overlap < s.segment && s.length >= s.segment);
  assert(samples >= static_cast<std::size_t>(s.segment));
  (void)samples, (void)s;
}

std::vector<double> frequencies(double rate, int length) {
  std::vector<double> f(length / 2 + 1);
  for (std::size_t k = 0; k < f.size(); ++k) f[k] = static_cast<double>(k) * rate / length;
  return f;
}

/// Divides sums over the segments by their number and converts them to one-sided densities per Hz:
/// the power of negative frequencies is added to that of positive ones.
template <class T>
void scale(std::vector<T>& sums, double rate, double window_power, int segments, int length) {
  const double factor = 1.0 / (rate * window_power);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const bool alone = k == 0 || (length % 2 == 0 && k + 1 == sums.size());
    sums[k] *= (alone ? 1.0 : 2.0) * factor / segments;
  }
}

}  // namespace

std::vector<double> window_values(SpectralWindow window, int count) {
  if (window == SpectralWindow::rectangular || count == 1) return std::vector<double>(count, 1.0);
  const bool hann =
      window == SpectralWindow::hann_periodic || window == SpectralWindow::hann_symmetric;
  const bool periodic =
      window == SpectralWindow::hann_periodic || window == SpectralWindow::hamming_periodic;
  const double mean = hann ? 0.5 : 0.54;
  const double step = 2.0 * std::numbers::pi / (periodic ? count : count - 1);
  std::vector<double> w(count);
  for (int i = 0; i < count; ++i) w[i] = mean - (1.0 - mean) * std::cos(step * i);
  return w;
}

WelchSettings welch_settings(Convention convention, int samples, std::optional<int> segment) {
  constexpr double kMatlabSegments = 4.5;  // eight half-overlapping segments cover 1 + 7/2 lengths
  constexpr int kMatlabLeastLength = 256;
  WelchSettings s;
  int own = 256;
  if (convention == Convention::octave) own = power_of_two(std::sqrt(samples));
  if (convention == Convention::matlab) own = static_cast<int>(samples / kMatlabSegments);
  s.segment = std::max(2, std::min(segment.value_or(own), samples));
  s.overlap = s.segment / 2;
  s.length = s.segment;
  if (convention == Convention::scipy) return s;
  s.window = SpectralWindow::hamming_symmetric;
  s.detrend = convention == Convention::octave ? Detrend::record_mean : Detrend::none;
  if (convention == Convention::matlab) {
    s.length = std::max(kMatlabLeastLength, power_of_two(s.segment));
  }
  return s;
}

int segment_count(int samples, const WelchSettings& s) {
  if (samples < s.segment) return 0;
  return (samples - s.overlap) / (s.segment - s.overlap);
}

Density power_density(std::span<const double> x, double rate, const WelchSettings& settings) {
  check(x.size(), settings);
  const Segments segments(x, settings);
  const int count = segment_count(static_cast<int>(x.size()), settings);
  Density density{frequencies(rate, settings.length), {}};
  density.value.assign(density.frequency.size(), 0.0);
  for (int k = 0; k < count; ++k) {
    const Spectrum X = segments(k);
    for (std::size_t i = 0; i < X.size(); ++i) density.value[i] += std::norm(X[i]);
  }
  scale(density.value, rate, segments.window_power(), count, settings.length);
  return density;
}

Densities densities(std::span<const double> x,
                    std::span<const double> y,
                    double rate,
                    const WelchSettings& settings) {
  check(x.size(), settings);
  assert(x.size() == y.size());
  const Segments of_x(x, settings), of_y(y, settings);
  Densities s;
  s.segments = segment_count(static_cast<int>(x.size()), settings);
  s.frequency = frequencies(rate, settings.length);
  s.xx.assign(s.frequency.size(), 0.0);
  s.yy = s.xx;
  s.xy.assign(s.frequency.size(), 0.0);
  for (int k = 0; k < s.segments; ++k) {
    const Spectrum X = of_x(k), Y = of_y(k);
    for (std::size_t i = 0; i < X.size(); ++i) {
      s.xx[i] += std::norm(X[i]);
      s.yy[i] += std::norm(Y[i]);
      s.xy[i] += std::conj(X[i]) * Y[i];
    }
  }
  scale(s.xx, rate, of_x.window_power(), s.segments, settings.length);
  scale(s.yy, rate, of_x.window_power(), s.segments, settings.length);
  scale(s.xy, rate, of_x.window_power(), s.segments, settings.length);
  return s;
}

std::vector<std::complex<double>> response_h1(const Densities& s) {
  std::vector<std::complex<double>> H(s.xy.size());
  for (std::size_t i = 0; i < H.size(); ++i) H[i] = s.xy[i] / s.xx[i];
  return H;
}

std::vector<std::complex<double>> response_h2(const Densities& s) {
  std::vector<std::complex<double>> H(s.xy.size());
  for (std::size_t i = 0; i < H.size(); ++i) H[i] = s.yy[i] / std::conj(s.xy[i]);
  return H;
}

std::vector<double> coherence(const Densities& s) {
  std::vector<double> gamma2(s.xy.size());
  for (std::size_t i = 0; i < gamma2.size(); ++i) {
    gamma2[i] = std::norm(s.xy[i]) / (s.xx[i] * s.yy[i]);
  }
  return gamma2;
}

}  // namespace latsch::numerics
