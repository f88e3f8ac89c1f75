// SPDX-License-Identifier: Apache-2.0
// Keys of .tir files that change no force in Latsch, each with the reason.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

/// Reason why a key is read and not used.
struct TirReason {
  std::string text;
  /// True if the program for which the key is intended computes something with it; the user is then
  /// told without requesting it.
  bool told = false;
};

/// Returns the reason why a key (in capitals) is not used; nothing if the key is a coefficient with
/// an effect or is not known at all. `value` is its text in the file: a key whose value means "off"
/// need not be reported.
std::optional<TirReason> reason_unused(std::string_view key, std::string_view value);

/// Returns in which models or modes a parameter has an effect; "" if it always has.
std::string_view acts_only(std::string_view parameter);

/// Returns all keys with a reason, for suggestions of similar names.
std::vector<std::string> keys_with_reason();

}  // namespace latsch::formats
