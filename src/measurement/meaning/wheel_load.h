// SPDX-License-Identifier: Apache-2.0
// Checks the vertical force of a recording without using its other channels.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace latsch {

/// Returns the reason why no tire has this vertical force, in words that follow the name of the
/// channel: half of the samples exceed 1 MN, which no tire carries. `values` are in N.
std::optional<std::string> impossible_load(std::span<const double> values);

/// Returns the reason why the signs cannot be those of iso axes: at least nine samples in ten are
/// below 0. Returns nothing if the channel's name is not that of a vertical force, such as "Fz" or
/// "FZ_hub".
std::optional<std::string> negative_load(const std::string& channel,
                                         std::span<const double> values);

/// Returns the reason why the vertical force of a test cannot be in the unit that its file states,
/// with the unit that would fit: in the middle of its samples it is a third of the load of the test
/// at most, or three times it at least. `load` is in N; without it, the reason is that no tire
/// carries less than 20 N. Returns nothing if fewer than nine samples in ten are above 0, as in a
/// recording from which its mean was taken, or if the name is not that of a vertical force.
std::optional<std::string> unlike_load(const std::string& channel,
                                       std::span<const double> values,
                                       std::optional<double> load);

}  // namespace latsch
