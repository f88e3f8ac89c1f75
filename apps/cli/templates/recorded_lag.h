// SPDX-License-Identifier: Apache-2.0
// Detects whether forces of a recording lag behind their slip, as those of a tire do that rolls
// while its slip changes: from the loop between a sweep up and a sweep down.
//
// A force with relaxation length sigma depends, in a slow sweep, on the slip at a distance sigma
// before:  F/Fz = c (s - sigma/|V| ds/dt) + c0.  This is fitted to small slips by least squares in
// s, ds/dt / |V| and 1, with s^3, and with the effects of load and camber on c and c0 if these
// vary; sigma is the ratio of the first two slopes. Its deviation includes that neighbors share
// noise (autocorrelation of the residuals at a lag of one sample, as for a process of order 1). The
// effects of pressure and of a warming tire count as noise.
#pragma once

#include <optional>
#include <string>

#include "correlation/laboratory/measurement.h"

namespace latsch::cli {

struct RecordedLag {
  double sigma = 0.0, deviation = 0.0;  // m
  double rate = 0.0;                    // 1/s or rad/s, close to the fastest of the sweep
  double speed = 0.0;                   // m/s

  /// True if sigma exceeds four deviations, and 1 cm, which a contact patch may hide.
  bool is_seen() const;
};

/// Determines the lag of a force behind its slip, from slips up to `most` at which the `other` slip
/// is small. Returns nullopt without time or speed, or with too few samples.
std::optional<RecordedLag> recorded_lag(const correlation::Measurement& measured,
                                        const std::string& force,
                                        const std::string& slip,
                                        double most);

}  // namespace latsch::cli
