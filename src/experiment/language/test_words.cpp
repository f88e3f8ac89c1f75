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

std::vector<ChannelInfo> force_channels(const std::vector<AxisFrame>& frames) {
  const auto names = force_names(frames);
  std::vector<ChannelInfo> channels;
  for (std::size_t k = 0; k < names.size(); ++k)
    channels.push_back({names[k],
                        names[k][0] == 'F' ? "N" : "N m",
                        name_of(frames[k * frames.size() / names.size()])});
  return channels;
}

}  // namespace latsch::experiment
