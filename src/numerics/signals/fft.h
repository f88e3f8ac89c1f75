// SPDX-License-Identifier: Apache-2.0
// The discrete Fourier transform of real samples, X_k = sum_n x_n exp(-2 pi i k n / N), by Eigen
// (which contains kissfft), with the half spectrum k = 0 .. N/2 that real samples need.
//
// Every length works; lengths with small prime factors, as returned by fast_length(), are fast.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace latsch::numerics {

using Spectrum = std::vector<std::complex<double>>;

/// Returns the bins 0 .. length/2 of the transform of x, which is padded with zeros to `length` >=
/// x.size().
Spectrum real_fft(std::span<const double> x, int length);

/// Returns the `length` samples of a half spectrum of length/2 + 1 bins, with the factor 1/length.
std::vector<double> inverse_real_fft(const Spectrum& half, int length);

/// Returns the least length >= `at_least` that is 4 times powers of 2, 3 and 5.
int fast_length(int at_least);

}  // namespace latsch::numerics
