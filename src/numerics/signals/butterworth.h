// SPDX-License-Identifier: Apache-2.0
// Butterworth filters of any order for sampled signals: as flat as possible in the pass band,
// 3 dB down at its edges. |H|^2 = 1 / (1 + (w/w_c)^(2n)) [Butterworth 1930], the analog prototype
// brought to the band and then to z by the bilinear transform with the edges prewarped
// [Oppenheim & Schafer, Discrete-Time Signal Processing, ch. 7].
#pragma once

#include <complex>
#include <vector>

#include "numerics/signals/digital_filter.h"

namespace latsch::numerics {

enum class Band { low_pass, high_pass, band_pass, band_stop };

/// gain * prod (z - zero) / prod (z - pole)
struct ZerosAndPoles {
  std::vector<std::complex<double>> zeros, poles;
  double gain = 1.0;
};

/// `edges`: one frequency for low and high pass, two rising ones for the bands; Hz, above 0 and
/// below rate / 2. order >= 1; bands have twice as many poles.
ZerosAndPoles butterworth(int order, Band band, const std::vector<double>& edges, double rate);

/// Sections of second order, those nearest the unit circle last.
std::vector<Section> sections_of(const ZerosAndPoles& filter);
RationalFilter polynomials_of(const ZerosAndPoles& filter);

}  // namespace latsch::numerics
