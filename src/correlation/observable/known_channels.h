// SPDX-License-Identifier: Apache-2.0
// The channels of a trial before there is one: what an experiment or a constraint may name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/rigs/rig_slopes.h"

namespace latsch::correlation {

struct KnownChannel {
  std::string name;        // "response/z": OUTPUT/QUANTITY
  std::string unit;        // in which people read it
  std::string frame = "";  // "W", "H" or "C" of a force or moment that a rig records
  std::optional<experiment::Regression> regression = {};  // of a slope
};

/// nullptr where none is called so.
const KnownChannel* find(const std::vector<KnownChannel>& channels, const std::string& name);
/// The one called `name`, which stands in `table` under `key`. InputError where there is none.
const KnownChannel& named_channel(const Node& table,
                                  const char* key,
                                  const std::string& name,
                                  const std::vector<KnownChannel>& channels);

}  // namespace latsch::correlation
