// SPDX-License-Identifier: Apache-2.0
// The channels of a trial, which are known before it runs. Experiments and constraints name them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/rigs/rig_slopes.h"

namespace latsch::correlation {

/// Returns CHANNEL of "TEST/CHANNEL".
inline std::string channel_part(const std::string& channel) {
  return channel.substr(channel.find_last_of('/') + 1);
}

struct KnownChannel {
  std::string name;        // "response/z": OUTPUT/QUANTITY
  std::string unit;        // unit for display
  std::string frame = "";  // "W", "H" or "C" if a rig records this force or moment
  std::optional<experiment::Regression> regression = {};  // for a slope: its computation
  bool has_frame_key = false;  // true if the key `frame` of its test chooses the frame
};

/// Returns nullptr if none has the given name.
const KnownChannel* find(const std::vector<KnownChannel>& channels, const std::string& name);
/// Returns the channel `name`, which `table` states under `key`. Throws InputError if there is
/// none.
const KnownChannel& named_channel(const Node& table,
                                  const char* key,
                                  const std::string& name,
                                  const std::vector<KnownChannel>& channels);

}  // namespace latsch::correlation
