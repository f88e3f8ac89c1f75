// SPDX-License-Identifier: Apache-2.0
// A recording of the four-post rig over frequency: spectral densities, and transfer functions from
// the combined motion of the posts to every sensor. Densities are computed by Welch's method
// (signals/welch.h: Hann window, mean of each segment removed, one-sided; segments overlap by seven
// eighths, because a sweep passes a line within one or two of them). Transfer functions and
// coherences use the whole record with local polynomials (numerics/signals/local_response.h):
// segments would cut off the response to excitation before them, which at the low end of a sweep is
// most of the response. So the record has to end at rest: the posts stand still after their motion
// (FourPostTest::still).
//   u = (±h_FL ± h_FR ± h_RL ± h_RR)/4      the mode's signal, m: in a sweep that of the post FL
//   H                                       y by u; phase positive if y leads
// Heave: ++++, pitch: ++--, roll: +-+-, warp: +--+. If posts also move otherwise, the response to
// that motion counts as noise, and the coherence falls.
//
//   frequency                               Hz, the lines in the band
//   psd_post                                m^2/Hz, of u
//   psd_pushrod_FL ..., psd_hub_FL ..., psd_body_z     N^2/Hz, m^2/s^4/Hz
//   tf_pushrod_FL ..., tf_hub_FL ..., tf_body_z        |H|, N/m, 1/s^2
//   phase_pushrod_FL ...                    rad, -π .. π
//   coherence_pushrod_FL ...                1
#pragma once

#include <string>
#include <vector>

#include "experiment/rigs/car/four_post_rig.h"

namespace latsch::experiment {

struct PostSpectra {
  double segment = 4.0;          // s, length
  double from = 0.5, to = 30.0;  // Hz, band of the lines
  double moving = 0.0;  // s from the start in which the posts move, used for densities; 0: the
                        // whole record
};

/// Sensors that have a transfer function; names and units of the channels.
std::vector<std::string> spectra_sensors();
std::vector<std::pair<std::string, std::string>> spectra_channels();

/// Computes the spectra of a recording of run(), at least as long as a segment, sampled at `rate`,
/// Hz.
Channels spectra(const Channels& record, PostMode mode, double rate, const PostSpectra& settings);

}  // namespace latsch::experiment
