// SPDX-License-Identifier: Apache-2.0
// Spectral densities by Welch's method: overlapping segments without their mean are windowed and
// transformed, and the squares averaged [Welch 1967].
//
//   S_xy(f) = 1/K sum_k conj(X_k(f)) Y_k(f) / (rate sum w^2)
//
// This is doubled for 0 < f < rate/2 (one-sided). H1 = S_xy / S_xx is the response x -> y, and the
// sum of S_xx times the bin width is the mean square.
//
// Programs differ in their defaults. The conventions by name:
//   scipy   Hann window, periodic; 256 samples; half overlaps; mean of each segment removed; no
//           zeros
//   octave  Hamming, symmetric; the power of 2 above sqrt(N); half overlaps; mean of the whole
//           record removed; no zeros
//   matlab  Hamming, symmetric; at most eight segments, N / 4.5 samples; half overlaps; no mean
//           removed; zeros up to the power of 2, 256 at least
// With equal window, segment and mean they agree: octave's pwelch with hanning(n, "periodic") and
// "short" mean removal is the scipy convention.
#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

namespace latsch::numerics {

enum class SpectralWindow {
  hann_periodic,
  hann_symmetric,
  hamming_periodic,
  hamming_symmetric,
  rectangular
};
enum class Detrend { none, segment_mean, segment_line, record_mean };

std::vector<double> window_values(SpectralWindow window, int count);

struct WelchSettings {
  int segment = 256;  // samples of a segment, from 2 to those of the record
  int overlap = 128;  // samples by which segments overlap, fewer than a segment has
  int length = 256;   // length of the transform: a segment and zeros
  SpectralWindow window = SpectralWindow::hann_periodic;
  Detrend detrend = Detrend::segment_mean;
};

enum class Convention { scipy, octave, matlab };

/// Returns the settings that the named program uses by default for a record of `samples`, with the
/// given length of segments or, if none is given, with its own. A segment longer than the record is
/// shortened to the record.
WelchSettings welch_settings(Convention convention,
                             int samples,
                             std::optional<int> segment = std::nullopt);

/// One-sided density at frequency[k] = k rate / length.
struct Density {
  std::vector<double> frequency;  // Hz
  std::vector<double> value;      // density, in the unit of x squared per Hz
};

Density power_density(std::span<const double> x, double rate, const WelchSettings& settings);

/// Densities S_xx, S_yy, S_xy of two records of the same length.
struct Densities {
  std::vector<double> frequency, xx, yy;
  std::vector<std::complex<double>> xy;
  int segments = 0;
};
Densities densities(std::span<const double> x,
                    std::span<const double> y,
                    double rate,
                    const WelchSettings& settings);

/// Returns the number of segments of a record.
int segment_count(int samples, const WelchSettings& settings);

/// Frequency responses x -> y: H1 = S_xy / S_xx (noise at the output), H2 = S_yy / S_yx (noise at
/// the input); coherence gamma^2 = |S_xy|^2 / (S_xx S_yy).
std::vector<std::complex<double>> response_h1(const Densities& s);
std::vector<std::complex<double>> response_h2(const Densities& s);
std::vector<double> coherence(const Densities& s);

}  // namespace latsch::numerics
