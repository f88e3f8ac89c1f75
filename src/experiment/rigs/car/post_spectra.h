// SPDX-License-Identifier: Apache-2.0
// A recording of the four-post rig over frequency: spectral densities, and transfer functions from
// what the posts do together to every sensor, by Welch's method (numerics/signals/welch.h: Hann
// window, mean of each segment removed, densities one-sided). Segments overlap by seven eighths: a
// sweep passes a line within one or two of them, and where these are far apart what they cut off
// stays in H1; so close together they leave H1 smoothed over the window's line width, 1.4/segment.
//   u = (±h_FL ± h_FR ± h_RL ± h_RR)/4      the mode's signal, m: in a sweep that of the post FL
//   H1 = S_uy/S_uu                          y by u; phase positive where y leads
// Heave: ++++, pitch: ++--, roll: +-+-, warp: +--+. Where posts also move otherwise, what follows
// from that counts as noise, and the coherence falls.
//
//   frequency                               Hz, the lines in the band
//   psd_post                                m^2/Hz, of u
//   psd_pushrod_FL ..., psd_hub_FL ..., psd_body_z     N^2/Hz, m^2/s^4/Hz
//   tf_pushrod_FL ..., tf_hub_FL ..., tf_body_z        |H1|, N/m, 1/s^2
//   phase_pushrod_FL ...                    rad, -π .. π
//   coherence_pushrod_FL ...                1
#pragma once

#include <string>
#include <vector>

#include "experiment/rigs/car/four_post_rig.h"

namespace latsch::experiment {

struct PostSpectra {
  double segment = 4.0;          // s
  double from = 0.5, to = 30.0;  // Hz, the lines that are kept
};

/// The sensors that have a transfer function, and the channels' names and units.
std::vector<std::string> spectra_sensors();
std::vector<std::pair<std::string, std::string>> spectra_channels();

/// Of what run() records, no shorter than a segment, sampled at this rate, Hz.
Channels spectra(const Channels& record, PostMode mode, double rate, const PostSpectra& settings);

}  // namespace latsch::experiment
