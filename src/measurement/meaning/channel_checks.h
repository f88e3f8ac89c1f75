// SPDX-License-Identifier: Apache-2.0
// Whether the numbers of a recording can be what its channels are taken for: signs and ranges of
// every channel whose meaning is known (channel_words.h), and whether channels that belong
// together have signs that fit, in iso axes.
//
//   channel                       expected                  impossible
//   Fz of a tire                  above 0                   below 0 in nearly all samples
//   alpha, gamma, toe, camber     below 90 deg              90 deg or more
//   Vx                            0 to 250 km/h             beyond 1,500 km/h
//   p                             20 kPa to 1.2 MPa         below 2 kPa, above 4 MPa
//   temperatures                  0 to 300 degC             below -100, above 1,000 degC
//   loaded_radius, R_e            0.05 to 3 m               below 0.01, above 10 m
//   kappa                         -1.05 to 1.5              beyond 100
//   mux, muy, friction            0 to 3
//   RIMDIAME                      below OVALLDIA            above it
//
//   slip angle and side force     opposite: Fy falls as alpha rises
//   slip angle, aligning moment   equal in small slip angles
//   inclination and side force    opposite, at one slip angle
//   kappa and Fx; dx, dy, dz and the force along them; Vx and omega     equal
//
// Loads about zero, as a K&C rig changes them or a cleat shakes them, are no loads on a tire.
//
// A channel of which at least nine samples of ten are impossible is an error, a minority of odd
// samples is counted. Not seen: a wrong number of a plausible size.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch {

struct ChannelDoubt {
  std::string channel;     // as it is called in the recording
  std::string sentence;    // follows the name: "is below 0 in 3 of 400 samples, ..."
  std::size_t sample = 0;  // the first odd one
  bool is_error = false;
  bool all_loads_negative = false;  // so another convention is likely
};

/// Of channels in SI and iso, in our names; gaps are NaN.
std::vector<ChannelDoubt> doubts_about(const Channels& channels);

/// Channels that are empty in some samples. A channel that is empty as a whole was not recorded.
std::vector<ChannelDoubt> gaps_in(const Channels& channels);

}  // namespace latsch
