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
  Channels channels;   // channels without the time; each has `samples` values
  int samples = 0;

  double time(double sample) const { return start + sample / rate; }
  /// Throws InputError naming the existing channels.
  std::span<const double> channel(const std::string& name) const;
};

/// Checks a recording and computes the sampling rate from its time channel. Throws InputError that
/// names the source, the channel, the sample and its time: if a channel is missing, of another
/// length or not finite, if there are fewer than 16 samples, or if the time does not rise, misses
/// samples or has steps that differ by more than a tenth.
DrumRecord drum_record(const Channels& channels,
                       const std::string& time_channel,
                       std::string source);

/// Throws InputError if the channel is missing or has a unit of another quantity. A plain number is
/// assumed to be in `unit`.
void expect_quantity(const DrumRecord& record, const std::string& channel, const std::string& unit);

/// Throws InputError if a channel is constant, because its sensor was then probably not connected.
void expect_varying(const DrumRecord& record, const std::string& channel);

}  // namespace latsch
