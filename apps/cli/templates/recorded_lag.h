// SPDX-License-Identifier: Apache-2.0
// Whether forces of a recording lag behind their slip, as those of a tire do that rolls on while
// its slip goes on: by the loop between a sweep up and a sweep down.
//
// A force that lags by a relaxation length sigma answers, in a slow sweep, to the slip it had sigma
// before:  F/Fz = c (s - sigma/|V| ds/dt) + c0.  That is fitted to small slips by least squares in
// s, ds/dt / |V| and 1, with s^3, and with what load and camber change in c and c0 where they vary;
// sigma is the ratio of the first two slopes. Its deviation takes into account that neighbors share
// noise (autocorrelation of the residuals at one sample, as of a process of order 1). What pressure
// and a tire that warms up change counts as noise.
#pragma once

#include <optional>
#include <string>

#include "correlation/laboratory/measurement.h"

namespace latsch::cli {

struct RecordedLag {
  double sigma = 0.0, deviation = 0.0;  // m
  double rate = 0.0;                    // 1/s or rad/s, nearly the fastest of the sweep
  double speed = 0.0;                   // m/s

  /// Four deviations, and more than a contact patch may hide: 1 cm.
  bool is_seen() const;
};

/// Of a force by its slip, of slips up to `most` where `other` slips are small. nullopt without
/// time or speed, or with too few samples.
std::optional<RecordedLag> recorded_lag(const correlation::Measurement& measured,
                                        const std::string& force,
                                        const std::string& slip,
                                        double most);

}  // namespace latsch::cli
