// SPDX-License-Identifier: Apache-2.0
// Butterworth filters of any order for sampled signals: maximally flat in the pass band, 3 dB down
// at its edges. |H|^2 = 1 / (1 + (w/w_c)^(2n)) [Butterworth 1930]. The analog prototype is
// transformed to the band, and then to z by the bilinear transform with prewarped edges [Oppenheim
// & Schafer, Discrete-Time Signal Processing, ch. 7].
#pragma once

#include <complex>
#include <vector>

#include "numerics/signals/digital_filter.h"

namespace latsch::numerics {

enum class FilterBand { low_pass, high_pass, band_pass, band_stop };

/// Filter gain * prod (z - zero) / prod (z - pole).
struct ZerosAndPoles {
  std::vector<std::complex<double>> zeros, poles;
  double gain = 1.0;
};

/// Designs a filter. `edges` has one frequency for low and high pass and two rising ones for band
/// pass and band stop, Hz, between 0 and rate / 2. `order` is at least 1; the band filters have
/// twice as many poles.
ZerosAndPoles butterworth(int order,
                          FilterBand band,
                          const std::vector<double>& edges,
                          double rate);

/// Returns second-order sections, those nearest the unit circle last.
std::vector<FilterSection> sections_of(const ZerosAndPoles& filter);
RationalFilter polynomials_of(const ZerosAndPoles& filter);

}  // namespace latsch::numerics
