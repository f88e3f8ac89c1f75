// SPDX-License-Identifier: Apache-2.0
#include "numerics/signals/time_delay.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "numerics/signals/fft.h"

namespace latsch::numerics {
namespace {

constexpr double kPi = std::numbers::pi;

/// The cross-correlation R_xy, computed from the transforms of both signals. They are padded with
/// zeros, so that the correlation is not periodic.
struct Correlation {
  Spectrum spectrum;           // conj(X) Y
  std::vector<double> values;  // R(l) has the index l; negative lags are at the end
  int length = 0;

  Correlation(std::span<const double> x, std::span<const double> y)
      : length(fast_length(static_cast<int>(x.size() + y.size()))) {
    const Spectrum X = real_fft(x, length);
    spectrum = real_fft(y, length);
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= std::conj(X[k]);
    values = inverse_real_fft(spectrum, length);
  }

  double at(int lag) const { return values[lag < 0 ? lag + length : lag]; }

  struct Slope {
    double value, first, second;
  };

  /// Returns R and its derivatives at any lag.
  Slope between(double lag) const {
    Slope sum{spectrum[0].real(), 0.0, 0.0};
    const int half = length / 2;
    const std::complex<double> turn = std::polar(1.0, 2.0 * kPi * lag / length);
    std::complex<double> e = 1.0;
    // Number of successive multiplications by `turn` after which the power is computed anew,
    // because the products accumulate rounding errors.
    constexpr int kRenew = 64;
    for (int k = 1; k <= half; ++k) {
      e = k % kRenew == 0 ? std::polar(1.0, 2.0 * kPi * k * lag / length) : e * turn;
      const double omega = 2.0 * kPi * k / length, weight = k == half ? 1.0 : 2.0;
      const std::complex<double> term = weight * spectrum[k] * e;
      sum.value += term.real();
      sum.first -= omega * term.imag();
      sum.second -= omega * omega * term.real();
    }
    return {sum.value / length, sum.first / length, sum.second / length};
  }
};

/// Finds the maximum of R by Newton's method, starting at the lag of the greatest sample of R. The
/// result is at most one sample away from this lag.
double maximum_near(const Correlation& r, int lag) {
  constexpr int kSteps = 20;
  constexpr double kEnough = 1e-10;  // samples
  double at = lag;
  for (int step = 0; step < kSteps; ++step) {
    const auto slope = r.between(at);
    if (slope.second >= 0.0) break;
    const double move = -slope.first / slope.second;
    at = std::clamp(at + move, lag - 1.0, lag + 1.0);
    if (std::abs(move) < kEnough) break;
  }
  return at;
}

double energy(std::span<const double> x) {
  return std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
}

/// Returns the modified Bessel function of order zero by its power series.
double bessel_i0(double x) {
  double term = 1.0, sum = 1.0;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    const double half = x / (2.0 * k);
    term *= half * half;
    sum += term;
  }
  return sum;
}

constexpr int kTaps = 2 * kInterpolationReach;

/// Returns interpolation weights of the samples -reach + 1 .. reach for a point that lies `share`
/// of a sample spacing after sample 0.
std::array<double, kTaps> interpolation_weights(double share) {
  // Parameter of the Kaiser window, with side lobes of 1e-6 (118 dB).
  constexpr double kBeta = 12.0;
  static const double whole = bessel_i0(kBeta);
  std::array<double, kTaps> weights{};
  for (int i = 0; i < kTaps; ++i) {
    const double t = i - (kInterpolationReach - 1) - share;
    const double edge = t / kInterpolationReach;
    const double sinc = t == 0.0 ? 1.0 : std::sin(kPi * t) / (kPi * t);
    weights[i] = sinc * bessel_i0(kBeta * std::sqrt(std::max(0.0, 1.0 - edge * edge))) / whole;
  }
  return weights;
}

double weighted(std::span<const double> x, long first, const std::array<double, kTaps>& weights) {
  const long last = static_cast<long>(x.size()) - 1;
  double sum = 0.0;
  if (first >= 0 && first + kTaps - 1 <= last) {
    for (int i = 0; i < kTaps; ++i) sum += weights[i] * x[first + i];
  } else {
    for (int i = 0; i < kTaps; ++i) sum += weights[i] * x[std::clamp(first + i, 0L, last)];
  }
  return sum;
}

/// Table of interpolation weights at evenly spaced positions between two samples; weights between
/// the rows are interpolated linearly.
class WeightTable {
 public:
  WeightTable() : rows_(kRows + 1) {
    for (int row = 0; row <= kRows; ++row) {
      rows_[row] = interpolation_weights(static_cast<double>(row) / kRows);
    }
  }
  std::array<double, kTaps> at(double share) const {
    const int row = std::min(kRows - 1, static_cast<int>(share * kRows));
    const double part = share * kRows - row;
    std::array<double, kTaps> weights;
    for (int i = 0; i < kTaps; ++i) {
      weights[i] = rows_[row][i] + part * (rows_[row + 1][i] - rows_[row][i]);
    }
    return weights;
  }

 private:
  // Number of rows. The error of linear interpolation, an eighth of the second difference of sinc,
  // is below 3e-8.
  static constexpr int kRows = 4096;
  std::vector<std::array<double, kTaps>> rows_;
};

}  // namespace

std::vector<double> autocorrelation(std::span<const double> x, int lags) {
  assert(lags >= 1 && static_cast<std::size_t>(lags) <= x.size());
  const int length = fast_length(static_cast<int>(x.size()) + lags);
  Spectrum X = real_fft(x, length);
  for (auto& value : X) value = std::norm(value);
  std::vector<double> r = inverse_real_fft(X, length);
  r.resize(lags);
  return r;
}

Delay delay_between(std::span<const double> x, std::span<const double> y, int lower, int upper) {
  const Correlation r(x, y);
  lower = std::max(lower, 1 - static_cast<int>(x.size()));
  upper = std::min(upper, static_cast<int>(y.size()) - 1);
  assert(lower <= upper);
  int best = lower;
  for (int lag = lower; lag <= upper; ++lag) {
    if (r.at(lag) > r.at(best)) best = lag;
  }
  Delay delay;
  delay.samples = std::clamp(maximum_near(r, best), 1.0 * lower, 1.0 * upper);
  const double scale = std::sqrt(energy(x) * energy(y));
  if (scale > 0.0) delay.likeness = r.between(delay.samples).value / scale;
  return delay;
}

std::vector<double> shifted(std::span<const double> x, double samples) {
  const int length = static_cast<int>(x.size());
  Spectrum X = real_fft(x, length);
  for (int k = 0; k < static_cast<int>(X.size()); ++k) {
    const double angle = -2.0 * kPi * k * samples / length;
    // At half the sampling rate only the real part of the phase rotation gives a real signal.
    X[k] *= 2 * k == length ? std::complex<double>(std::cos(angle)) : std::polar(1.0, angle);
  }
  return inverse_real_fft(X, length);
}

std::vector<double> values_between(std::span<const double> x, double start, int count) {
  const double whole = std::floor(start);
  const auto weights = interpolation_weights(start - whole);
  const long first = static_cast<long>(whole) - (kInterpolationReach - 1);
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) values[i] = weighted(x, first + i, weights);
  return values;
}

std::vector<double> values_at(std::span<const double> x, std::span<const double> places) {
  static const WeightTable table;
  std::vector<double> values;
  values.reserve(places.size());
  for (const double place : places) {
    const double whole = std::floor(place);
    const long first = static_cast<long>(whole) - (kInterpolationReach - 1);
    values.push_back(weighted(x, first, table.at(place - whole)));
  }
  return values;
}

}  // namespace latsch::numerics
