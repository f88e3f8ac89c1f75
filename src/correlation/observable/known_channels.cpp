// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/known_channels.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"

namespace latsch::correlation {

const KnownChannel* find(const std::vector<KnownChannel>& channels, const std::string& name) {
  const auto found = std::find_if(
      channels.begin(), channels.end(), [&](const KnownChannel& one) { return one.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

const KnownChannel& named_channel(const Node& table,
                                  const char* key,
                                  const std::string& name,
                                  const std::vector<KnownChannel>& channels) {
  if (const KnownChannel* channel = find(channels, name)) return *channel;
  std::vector<std::string> names;
  for (const KnownChannel& channel : channels) names.push_back(channel.name);
  table.reject(key,
               fmt::format("is {}, which no test records{}; there are {}",
                           in_quotes(name),
                           did_you_mean(name, names),
                           list_of(names)));
}

}  // namespace latsch::correlation
