// SPDX-License-Identifier: Apache-2.0
// The parts of a drum run at constant speed: where the speed, low-passed without delay, stays
// within a margin of a target, without a bit at both ends [thesis K, 2.2: 1 Hz; the order is not
// given there].
#pragma once

#include <string>
#include <vector>

#include "measurement/drum_record.h"

namespace latsch {

struct PlateauSettings {
  double low_pass = 1.0;  // Hz, Butterworth forward and backward
  int order = 4;
  double margin = 0.3;    // m/s, about the target
  double trim = 1.0;      // s, taken away at each end: the speed's transient and the filter's
  double shortest = 2.0;  // s, what must be left
};

/// Samples first .. end - 1.
struct Plateau {
  double target = 0.0;  // m/s
  int first = 0, end = 0;
  double mean = 0.0;   // m/s, of the low-passed speed
  double range = 0.0;  // m/s, between its least and greatest value

  int samples() const { return end - first; }
};

/// The low-passed speed of a record. Throws InputError where it is too short for the filter or the
/// filter is not below half the rate.
std::vector<double> smooth_speed(const DrumRecord& record,
                                 const std::string& speed_channel,
                                 const PlateauSettings& settings);

/// The longest stretch at each target speed (m/s), in the order of the targets. Throws InputError
/// naming the target, how near the speed came and for how long.
std::vector<Plateau> find_plateaus(const DrumRecord& record,
                                   const std::string& speed_channel,
                                   const std::vector<double>& targets,
                                   const PlateauSettings& settings);

/// The speeds (m/s, rising) that a record holds long enough for a plateau: of its stretches within
/// the margin of one speed the longest, then the longest of what is left. Standstill is none.
/// Throws InputError as smooth_speed does, and where there is none.
std::vector<double> held_speeds(const DrumRecord& record,
                                const std::string& speed_channel,
                                const PlateauSettings& settings);

}  // namespace latsch
