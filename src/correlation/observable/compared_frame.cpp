// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/compared_frame.h"

#include <fmt/format.h>

#include "base/text.h"
#include "correlation/observable/known_channels.h"
#include "measurement/axes.h"

namespace latsch::correlation {
namespace {

/// Returns the frame that the measurement states or, if it states none, the experiment.
std::string measured_frame(const Node& table,
                           const std::string& column,
                           const std::string& stated,
                           const Measurement& measurement) {
  const std::string frame = measurement.frame(column);
  if (stated.empty()) return frame;
  if (!frame.empty() && frame != stated)
    table.reject("frame",
                 fmt::format("is {}, but the measurement has the column {} in axes {}",
                             in_quotes(stated),
                             in_quotes(measurement.written(column).column),
                             frame));
  return stated;
}

[[noreturn]] void reject_frame(const Node& table,
                               const std::string& frame,
                               const KnownChannel& channel,
                               const Measurement& measurement) {
  const char* key = table.has("frame") ? "frame" : "measurement";
  if (channel.frame.empty())
    table.reject(key,
                 fmt::format("is in axes {}, but {} is no force or moment in a frame",
                             frame,
                             in_quotes(channel.name)));
  const std::string turned = fmt::format(
      "in_frame = \"{}\" into {}, which turns the measurement",
      channel.frame,
      measurement.is_stated() ? "[measurement." + measurement.name() + "]"
                              : "a [measurement.NAME] of " + in_quotes(measurement.name()));
  const std::string chosen =
      channel.has_frame_key
          ? fmt::format(
                ", or frame = \"{0}\" into [test.{2}] or its file (several: [\"{1}\", "
                "\"{0}\"])",
                frame,
                channel.frame,
                channel.name.substr(0, channel.name.find('/')))
          : "";
  table.reject(key,
               fmt::format("is in axes {}, but {} is recorded in axes {}; put {}{}",
                           frame,
                           in_quotes(channel.name),
                           channel.frame,
                           turned,
                           chosen));
}

}  // namespace

std::vector<std::string> forces_beside(const std::string& channel) {
  const std::size_t at = channel.size() - channel_part(channel).size();
  std::vector<std::string> forces;
  for (const char* force : {"Fx", "Fy", "Fz", "Mx", "My", "Mz"})
    forces.push_back(channel.substr(0, at) + force + channel.substr(at + 2));
  return forces;
}

bool is_same_in(const std::string& channel, const std::string& frame, const std::string& other) {
  return frame == other || (channel.starts_with('F') && frame != "C" && other != "C");
}

const KnownChannel& channel_in_measured_frame(const Node& table,
                                              const char* key,
                                              const std::string& named,
                                              const std::string& stated,
                                              const std::vector<KnownChannel>& channels,
                                              const Measurement& measurement) {
  const std::string column = channel_part(named);
  const std::string frame = measured_frame(table, column, stated, measurement);
  const KnownChannel* channel = find(channels, named);
  if (!channel && !frame.empty()) channel = find(channels, named + frame);
  if (!channel) {
    std::vector<std::string> recorded;
    for (const KnownChannel& known : channels)
      if (!known.frame.empty() && known.name == named + known.frame) recorded.push_back(known.name);
    if (recorded.empty())
      channel = &named_channel(table, key, named, channels);
    else
      table.reject(key,
                   fmt::format("is {}, which is recorded in several axes, {}: name one of them{}",
                               in_quotes(named),
                               list_of(recorded),
                               frame.empty() ? ", or say by frame in which the measurement is"
                                             : "; the measurement is in axes " + frame));
  }
  if (!frame.empty() && !is_same_in(column, frame, channel->frame))
    reject_frame(table, frame, *channel, measurement);
  return *channel;
}

}  // namespace latsch::correlation
