// SPDX-License-Identifier: Apache-2.0
// Recognizes channels of a record by name and unit. The vocabulary is
// measurement/meaning/channel_words.h; a name counts only if the unit has the name's dimension.
#pragma once

#include <string>
#include <vector>

namespace latsch::correlation {

/// Returns Latsch's name of a file's channel `name` with the SI unit `unit`, or `name` itself if it
/// is unknown.
std::string our_name(const std::string& name, const std::string& unit);

/// Returns the SI unit that a column of the given name must have; empty if the name is ambiguous,
/// as a single letter is.
std::string dimension_of_name(const std::string& name);

/// Returns the force or moment without its frame: "Fy", "FyW", "MZH", "FxH_L" -> "Fy", "Fy", "Mz",
/// "Fx_L"; empty for any other name.
std::string force_without_frame(const std::string& name);

/// Channel found among others. The name of a force or moment may contain its frame: "Fy", "FyW",
/// "FZH", "FxH_L".
struct NamedChannel {
  std::string name, frame;  // empty: not found
};
/// Returns the channel called `wanted`: one of this name, of another spelling, or with a frame
/// appended.
NamedChannel find_named(const std::vector<std::string>& names, const std::string& wanted);

}  // namespace latsch::correlation
