// SPDX-License-Identifier: Apache-2.0
// Correlations of sampled signals by the Fourier transform, and delays finer than a sample.
//
//   R_xy(l) = sum_n x_n y_(n+l)
//
// Between the lags R is the trigonometric polynomial through them, so for signals below half the
// sampling rate the place of its maximum is exact; it is found from the greatest lag by Newton's
// method. (A parabola through three lags is wrong by up to some hundredths of a sample.)
#pragma once

#include <span>
#include <vector>

namespace latsch::numerics {

/// R_xx at the lags 0 .. lags - 1; lags <= x.size().
std::vector<double> autocorrelation(std::span<const double> x, int lags);

/// By how many samples y comes after x, lower <= delay <= upper: the maximum of R_xy.
struct Delay {
  double samples = 0.0;
  double likeness = 0.0;  // R_xy there over the root of R_xx(0) R_yy(0): 1 for the same shape
};
Delay delay_between(std::span<const double> x, std::span<const double> y, int lower, int upper);

/// x later by so many samples, which need not be whole; as if x went on periodically.
std::vector<double> shifted(std::span<const double> x, double samples);

/// `count` values of the signal between its samples at start, start + 1, ...: sinc interpolation
/// under a Kaiser window over 2 kInterpolationReach samples, good to 2e-6 of a component below 0.7
/// of half the sampling rate. Behind its ends the signal is taken to stay as its last sample.
std::vector<double> values_between(std::span<const double> x, double start, int count);
/// At any places, ascending or not.
std::vector<double> values_at(std::span<const double> x, std::span<const double> places);
inline constexpr int kInterpolationReach = 24;

}  // namespace latsch::numerics
