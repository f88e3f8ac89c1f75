// SPDX-License-Identifier: Apache-2.0
// Fits the four numbers of (3-3) to measurements: first to the frequency response of a hammer test,
// then so that the filtered dummy-rim passages match the real-rim passages [thesis K, 3.1].
//
// The first fit weights each frequency by the variance of H1, (1 - gamma^2) / (2 n gamma^2) |H|^2
// over n hits [Bendat & Piersol, Random Data, 9.2]. Its start is found automatically: for each
// point on a grid of f and zeta the best A and c follow linearly.
//
// The second fit treats both average passages as periodic and compares their Fourier coefficients
// in a band, which equals the sum of squares of the time series (Parseval). The two runs have no
// common clock, so a delay between them is a fifth unknown. A constant offset does not matter.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "measurement/rig_response.h"
#include "numerics/signals/welch.h"

namespace latsch {

struct FrequencyBand {
  double lower = 0.0, upper = 0.0;  // Hz
};

struct FittedResponse {
  RigResponse response;
  /// Standard deviations of A/f^2, f (rad/s), zeta and c by linear theory.
  double sigma_gain = 0.0, sigma_f = 0.0, sigma_zeta = 0.0, sigma_c = 0.0;
  double delay = 0.0;  // s, delay of the real run relative to the dummy run; second fit only
  /// root mean square over the frequencies, of |H| or of the signal (in the signal's unit)
  double residual = 0.0;
  bool converged = false;
};

/// A measured frequency response: H at frequency[k] with coherence[k], from `hits` hits.
struct MeasuredResponse {
  std::vector<double> frequency;  // Hz
  std::vector<std::complex<double>> H;
  std::vector<double> coherence;
  int hits = 1;
};

/// Throws InputError if the band contains fewer than 8 frequencies.
FittedResponse fit_to_response(const MeasuredResponse& measured,
                               FrequencyBand band,
                               std::optional<RigResponse> start = std::nullopt);

/// One load case: averages of the dummy-rim and real-rim passages, of equal length.
struct RimPair {
  std::vector<double> dummy, real;
};

/// Fits one filter, from dummy to real rim, to all pairs together.
FittedResponse fit_to_rims(const std::vector<RimPair>& pairs,
                           double rate,
                           FrequencyBand band,
                           const RigResponse& start);

}  // namespace latsch
