// SPDX-License-Identifier: Apache-2.0
// Names of channels of a record: the vocabulary is measurement/meaning/channel_words.h; here a name
// counts where its unit is of that dimension.
#pragma once

#include <string>
#include <vector>

namespace latsch::correlation {

/// Our name of what a file calls `name`, in the SI unit `unit`; `name` where we have none.
std::string our_name(const std::string& name, const std::string& unit);

/// The SI unit that a column of that name has to have; empty where the name says nothing: one
/// letter means much.
std::string dimension_of_name(const std::string& name);

/// "Fy", "FyW", "MZH" -> "Fy", "Fy", "Mz"; empty for what is no force or moment.
std::string force_without_frame(const std::string& name);

/// A channel among others; the name of a force or moment may say its frame: "Fy", "FyW", "FZH".
struct NamedChannel {
  std::string name, frame;  // empty: there is none
};
/// The one that `wanted` means: called so, another spelling of it, or with a frame behind it.
NamedChannel find_named(const std::vector<std::string>& names, const std::string& wanted);

}  // namespace latsch::correlation
