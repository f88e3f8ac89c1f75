// SPDX-License-Identifier: Apache-2.0
// The frequency response x -> y of a whole record, without window and averages. Around every
// frequency a polynomial is fitted to the record's transforms at 2 n + 1 of its own lines [local
// polynomial method of Schoukens and others; McKelvey, Guérin 2012, 16th IFAC Symposium on System
// Identification, reviews it],
//   Y(f_k) = (h_0 + h_1 r + ... + h_p r^p) U(f_k) + e_k,   r = (f_k - f) / width,   H(f) = h_0
// U, Y are transforms of the differences from sample to sample. If a record begins and ends at
// rest, with any mean, Y = H U holds exactly for them, and no term is needed for truncation by a
// window. A record that ends in motion gives a distorted response, because its end is missing.
//   γ² = 1 - (Σ|e|² / (2 n - p)) / (Σ|Y|² / (2 n + 1))       the share of y that follows x
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace latsch::numerics {

struct LocalSettings {
  int lines = 5;       // n, lines to either side, at least
  double width = 0.0;  // Hz, to either side, at least
  int order = 4;       // p
};

struct LocalResponse {
  std::vector<std::complex<double>> response;  // H, at the given frequencies
  std::vector<double> coherence;               // γ², 0 if x or y is zero there
};

/// Takes two records of one length, sampled at `rate`, Hz. Frequencies are in Hz, below half of the
/// rate. The record must have at least 2 n + 2 lines.
LocalResponse local_response(std::span<const double> x,
                             std::span<const double> y,
                             double rate,
                             std::span<const double> frequencies,
                             const LocalSettings& settings = {});

}  // namespace latsch::numerics
