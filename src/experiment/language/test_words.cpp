// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/test_words.h"

#include <fmt/format.h>

#include <numbers>

namespace latsch::experiment {

std::string degrees(double angle) {
  return fmt::format("{:.3g} deg", angle * 180.0 / std::numbers::pi);
}

std::string cambered(double camber) {
  return camber == 0.0 ? "" : fmt::format(", camber {}", degrees(camber));
}

std::vector<ChannelInfo> framed(std::vector<ChannelInfo> channels, AxisFrame frame) {
  for (ChannelInfo& channel : channels)
    if (channel.unit == "N" || channel.unit == "N m") channel.frame = name_of(frame);
  return channels;
}

}  // namespace latsch::experiment
