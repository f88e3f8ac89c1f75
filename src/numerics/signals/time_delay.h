// SPDX-License-Identifier: Apache-2.0
// Correlations of sampled signals by the Fourier transform, and delays with sub-sample resolution.
//
//   R_xy(l) = sum_n x_n y_(n+l)
//
// Between whole lags, R is the trigonometric polynomial through its values at these, so the
// position of its maximum is exact for signals below half the sampling rate. The maximum is found
// by Newton's method from the whole lag with the greatest R. (A parabola through three lags has an
// error of up to some hundredths of a sample.)
#pragma once

#include <span>
#include <vector>

namespace latsch::numerics {

/// Returns R_xx at the lags 0 .. lags - 1; lags <= x.size().
std::vector<double> autocorrelation(std::span<const double> x, int lags);

/// Delay of y after x, lower <= delay <= upper: the maximum of R_xy.
struct Delay {
  double samples = 0.0;
  double likeness = 0.0;  // R_xy at the delay divided by sqrt(R_xx(0) R_yy(0)); 1 for equal shapes
};
Delay delay_between(std::span<const double> x, std::span<const double> y, int lower, int upper);

/// Returns x delayed by `samples`, which need not be whole, as if x were periodic.
std::vector<double> shifted(std::span<const double> x, double samples);

/// Returns `count` values of the signal at start, start + 1, ..., between its samples: sinc
/// interpolation under a Kaiser window over 2 kInterpolationReach samples. The error is 2e-6 of a
/// component below 0.7 of half the sampling rate. Beyond its ends the signal keeps its first or
/// last sample.
std::vector<double> values_between(std::span<const double> x, double start, int count);
/// Returns the values at any positions, in any order.
std::vector<double> values_at(std::span<const double> x, std::span<const double> places);
inline constexpr int kInterpolationReach = 24;

}  // namespace latsch::numerics
