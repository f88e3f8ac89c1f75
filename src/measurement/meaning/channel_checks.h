// SPDX-License-Identifier: Apache-2.0
// Checks whether the numbers of a recording are plausible for the meaning of its channels: signs
// and ranges of every channel whose meaning is known (channel_words.h), and signs of channels that
// belong together, in iso axes.
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
//   |Fx| / Fz, |Fy| / Fz          0 to 3, where Fz is above a fifth of its median
//   dx, dy, dz, travel            0.1 m, 0.5 m              beyond 10 m
//   deflection, rack              0.5 m, 0.3 m              beyond 10 m
//   Fx over dx, Fy over dy        100 N/mm to 200 kN/mm, if one follows the other
//   Fz over dz, travel            1 N/mm to 20 kN/mm; over a tire's deflection 10 N/mm to 10 kN/mm
//   RIMDIAME                      below OVALLDIA            above it
//
//   slip angle and side force     opposite: Fy falls as alpha rises
//   slip angle, aligning moment   equal in small slip angles
//   inclination and side force    opposite, at one slip angle
//   time                          rises from sample to sample of a run
//   kappa and Fx; dx, dy, dz and the force along them; Vx and omega     equal
//
// The signs of toe, camber, caster and steer of a K&C table: suspension_checks.h.
//
// A load channel that varies about zero, as on a K&C rig or over a cleat, holds no tire loads, and
// its sign is not checked.
//
// A channel with at least nine impossible samples in ten is an error; a minority of odd samples is
// counted. A wrong number of a plausible size is not detected.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measurement/channels.h"

namespace latsch {

struct ChannelDoubt {
  std::string channel;     // name of the channel in the recording
  std::string sentence;    // sentence that follows the name: "is below 0 in 3 of 400 samples, ..."
  std::size_t sample = 0;  // index of the first suspicious sample
  bool is_error = false;
  /// true if all loads are negative, which suggests another convention
  bool all_loads_negative = false;
  bool is_of_sign = false;  // true for a contradiction between signs; changing a sign removes it
};

/// Checks channels in SI and iso with Latsch's names; gaps are NaN. `breaks` are the samples at
/// which another file begins, whose time may start again.
std::vector<ChannelDoubt> doubts_about(const Channels& channels,
                                       const std::vector<std::size_t>& breaks = {});

/// Returns the channels that have gaps. A channel that is empty in all samples counts as not
/// recorded.
std::vector<ChannelDoubt> gaps_in(const Channels& channels);

}  // namespace latsch
