// SPDX-License-Identifier: Apache-2.0
// One run of a drum rig: channels sampled at a constant rate.
#pragma once

#include <span>
#include <string>

#include "measurement/channels.h"

namespace latsch {

struct DrumRecord {
  std::string source;  // the file, for messages
  double rate = 0.0;   // Hz
  double start = 0.0;  // s, time of the first sample
  Channels channels;   // all of `samples` values, without the time
  int samples = 0;

  double time(double sample) const { return start + sample / rate; }
  /// Throws InputError naming the channels there are.
  std::span<const double> channel(const std::string& name) const;
};

/// Checks what was recorded and takes the rate from its time channel. Throws InputError naming the
/// source, the channel, sample and time: a channel missing, of another length or not finite, fewer
/// than 16 samples, time that does not rise, misses samples or is not uniform to a tenth of a step.
DrumRecord drum_record(Channels channels, const std::string& time_channel, std::string source);

/// Throws InputError where the channel is missing or states a unit of another quantity. A plain
/// number is taken to be in `unit`.
void expect_quantity(const DrumRecord& record, const std::string& channel, const std::string& unit);

/// Throws InputError where a channel has the same value all the time: its sensor was not connected.
void expect_varying(const DrumRecord& record, const std::string& channel);

}  // namespace latsch
