// SPDX-License-Identifier: Apache-2.0
// The frequency response x -> y of a whole record without window and without averages: a polynomial
// of the frequency beside every line, fitted to the record's transforms at 2 n + 1 of its own lines
// [local polynomial method of Schoukens and others; McKelvey, Guérin 2012, 16th IFAC Symposium on
// System Identification, reviews it],
//   Y(f_k) = exp(-2πi (f_k - f) τ) (h_0 + h_1 r + ... + h_p r^p) U(f_k) + e_k,
//   r = (f_k - f) / width,   H(f) = h_0
// A response begins at an instant and lasts for a while. With the delay τ in the middle of this
// duration, the polynomial represents only half of the rotation of the phase over frequency.
// U, Y: transforms of the differences between successive samples. For a record that begins and
// ends at rest, at any level, Y = H U holds exactly, so the fit needs no term for the effect of
// windows. If a record ends in motion, the missing end of its response causes errors.
//   γ² = 1 - (Σ|e|²/(2 n - p) + Σ|B|²/(2 n + 1)) / (Σ|Y|² + Σ|B|²) (2 n + 1)
// B is the transform of a signal that is known to have no linear relation to x, if there is one.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace latsch::numerics {

struct LocalSettings {
  int lines = 5;       // least number n of lines to either side
  double width = 0.0;  // least width to either side, Hz
  int order = 4;       // p
  double delay = 0.0;  // τ, s
};

struct LocalResponse {
  std::vector<std::complex<double>> response;  // frequency response H at the given frequencies
  std::vector<double> coherence;               // γ²; 0 if x or y is zero at that frequency
};

/// Requires two records of equal length, sampled at `rate`, Hz, and frequencies below rate / 2, Hz.
/// The transform of a record must have at least 2 n + 2 lines. `beside` is the signal of B; it is
/// as long as the records, or empty.
LocalResponse local_response(std::span<const double> x,
                             std::span<const double> y,
                             double rate,
                             std::span<const double> frequencies,
                             const LocalSettings& settings = {},
                             std::span<const double> beside = {});

}  // namespace latsch::numerics
