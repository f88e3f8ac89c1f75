// SPDX-License-Identifier: Apache-2.0
// Checks of a vertical force that a rig recorded, apart from the other channels of the recording.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace latsch {

/// Returns the reason why no tire has such a vertical force, to follow the name of the channel:
/// half of its samples exceed 1 MN, which no tire carries. `values` in N.
std::optional<std::string> impossible_load(std::span<const double> values);

/// Returns the reason why the signs are not those of iso axes: at least nine samples in ten are
/// below 0. Returns nothing if the name is not that of a vertical force, "Fz" or "FZ_hub".
std::optional<std::string> negative_load(const std::string& channel,
                                         std::span<const double> values);

}  // namespace latsch
