// SPDX-License-Identifier: Apache-2.0
// Plateaus are the parts of a drum run at constant speed: the speed, low-passed without delay,
// stays within a margin of a target; a short time at both ends is discarded [thesis K, 2.2: 1 Hz;
// the order is not given there].
#pragma once

#include <string>
#include <vector>

#include "measurement/drum_record.h"

namespace latsch {

struct PlateauSettings {
  double low_pass = 1.0;  // Hz, Butterworth forward and backward
  int order = 4;
  double margin = 0.3;    // m/s, about the target
  double trim = 1.0;      // s, discarded at each end: transients of the speed and the filter
  double shortest = 2.0;  // s, least length after trimming
};

/// Consists of the samples first .. end - 1.
struct Plateau {
  double target = 0.0;  // m/s
  int first = 0, end = 0;
  double mean = 0.0;   // m/s, mean of the low-passed speed
  double range = 0.0;  // m/s, difference of its greatest and least value

  int samples() const { return end - first; }
};

/// Returns the low-passed speed of a record. Throws InputError if the record is too short for the
/// filter, the filter frequency is not below half the rate, or the drum never turns forward.
std::vector<double> smooth_speed(const DrumRecord& record,
                                 const std::string& speed_channel,
                                 const PlateauSettings& settings);

/// Returns the longest stretch at each target speed (m/s), in the order of the targets. Throws
/// InputError naming the target, how near the speed came and for how long.
std::vector<Plateau> find_plateaus(const DrumRecord& record,
                                   const std::string& speed_channel,
                                   const std::vector<double>& targets,
                                   const PlateauSettings& settings);

/// Returns the constant speeds (m/s, ascending) at which a record stays long enough for a plateau:
/// first the longest stretch within the margin of one speed, then the longest of the remaining
/// samples, and so on. Standstill does not count. Throws InputError for the same reasons as
/// smooth_speed(), and if there is no such speed.
std::vector<double> held_speeds(const DrumRecord& record,
                                const std::string& speed_channel,
                                const PlateauSettings& settings);

}  // namespace latsch
