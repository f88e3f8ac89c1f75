// SPDX-License-Identifier: Apache-2.0
// A recording of the four-post rig over frequency: spectral densities, and transfer functions from
// the joint motion of the posts to every sensor. Densities by Welch's method (signals/welch.h: Hann
// window, mean of each segment removed, one-sided; segments overlap by seven eighths, as a sweep
// passes a line within one or two of them). Transfer functions and coherences of the whole record
// by local polynomials (numerics/signals/local_response.h): segments would cut off the part of a
// line's response to earlier motion, which is most of it at the low end of a sweep. So the record
// has to end at rest: after their motion the posts rest for a time (FourPostTest::still). Two runs
// are needed, y+ and one with the posts upside down, y-. The response is that of (y+ - y-)/2, which
// has no even powers of u: the second harmonic of a sweep and the shift of the mean by a nonlinear
// law contribute to lines at which the posts do not move at that time, and exceed a small response
// there. (y+ + y-)/2 follows no linear law and lowers the coherence.
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
  double from = 0.5, to = 30.0;  // Hz, band of the computed lines
  /// Time from the start, s, in which the posts move, used for densities; 0: the whole record.
  double moving = 0.0;
};

/// Sensors that have a transfer function; names and units of the channels.
std::vector<std::string> spectra_sensors();
std::vector<std::pair<std::string, std::string>> spectra_channels();

/// Requires records of at least one segment, sampled at this rate, Hz. Densities are those of the
/// run with unchanged heights of the posts.
Channels spectra(const BothWays& runs, PostMode mode, double rate, const PostSpectra& settings);

}  // namespace latsch::experiment
