// SPDX-License-Identifier: Apache-2.0
// Detects whether the forces of a recording lag behind the slip, as those of a rolling tire do
// while its slip changes: the forces of a sweep up and of a sweep down then form a loop.
//
// In a slow sweep, a force with relaxation length sigma depends on the slip s at a distance sigma
// before: F/Fz = c (s - sigma/|V| ds/dt) + c0. This law is fitted to small slips by least squares
// in s, ds/dt / |V| and 1, with s^3, and with the effects of load and camber on c and c0 if these
// vary; sigma is the ratio of the first two coefficients. The standard deviation of sigma accounts
// for noise that neighboring samples share (autocorrelation of the residuals at a lag of one
// sample, as for a process of order 1). The effects of pressure and of a warming tire count as
// noise.
#pragma once

#include <optional>
#include <string>

#include "correlation/laboratory/measurement.h"

namespace latsch::cli {

struct RecordedLag {
  double sigma = 0.0, deviation = 0.0;  // m
  double rate = 0.0;   // 1/s or rad/s, rate of change of the slip, near the fastest of the sweep
  double speed = 0.0;  // m/s

  /// True if sigma exceeds four standard deviations and 1 cm; a smaller lag may be that of the
  /// contact patch itself.
  bool is_seen() const;
};

/// Determines the lag of a force behind its slip, from samples whose slip is at most `most` and
/// whose `other` slip is small. Returns nullopt if time or speed is missing or if there are too few
/// samples.
std::optional<RecordedLag> recorded_lag(const correlation::Measurement& measured,
                                        const std::string& force,
                                        const std::string& slip,
                                        double most);

}  // namespace latsch::cli
