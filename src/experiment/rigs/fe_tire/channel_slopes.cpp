// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/channel_slopes.h"

#include <algorithm>

namespace latsch::experiment {

Channels with_slopes(const Channels& channels, const ChannelSlopes& slopes) {
  Channels all;
  for (Channel channel : channels.all()) {
    for (const auto& [name, of] : slopes)
      if (channel.name == name) channel.slopes.assign(of.data(), of.data() + of.size());
    all.add(std::move(channel));
  }
  return all;
}

bool any_asked(const std::vector<std::string>& asked, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& name) {
    return std::ranges::find(asked, name) != asked.end();
  });
}

}  // namespace latsch::experiment
