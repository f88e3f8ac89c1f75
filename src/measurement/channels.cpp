// SPDX-License-Identifier: Apache-2.0
#include "measurement/channels.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <utility>

#include "base/text.h"

namespace latsch {

void Channels::add(Channel channel) {
  assert(!find(channel.name));
  channels_.push_back(std::move(channel));
}

const Channel* Channels::find(std::string_view name) const {
  const auto found = std::find_if(
      channels_.begin(), channels_.end(), [&](const Channel& c) { return c.name == name; });
  return found == channels_.end() ? nullptr : &*found;
}

bool Channels::has_slopes() const {
  return std::any_of(channels_.begin(), channels_.end(), [](const Channel& channel) {
    return !channel.slopes.empty();
  });
}

const std::vector<double>& Channels::operator[](std::string_view name) const {
  if (const Channel* channel = find(name)) return channel->values;
  std::vector<std::string> names;
  for (const Channel& channel : channels_) names.push_back(channel.name);
  throw std::out_of_range(
      "no channel " + in_quotes(name) + did_you_mean(name, names) +
      (names.empty() ? " (there are none)" : " (channels: " + list_of(names) + ")"));
}

}  // namespace latsch
