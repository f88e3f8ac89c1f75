// SPDX-License-Identifier: Apache-2.0
// Keys of .tir files that change no force here, each with the reason.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

/// Reason why a key is read and not used.
struct TirReason {
  std::string text;
  /// True if the program for which the key is meant computes something with it: the user then is
  /// informed even without asking.
  bool told = false;
};

/// Returns nothing if the key (in capitals) is a coefficient with an effect, or is not known at
/// all. `value` is the text in the file; a key whose value means "off" need not be reported.
std::optional<TirReason> reason_unused(std::string_view key, std::string_view value);

/// Returns the effect of a parameter that acts only in some models or modes; "" if it always
/// acts.
std::string_view acts_only(std::string_view parameter);

/// Returns keys with a reason, for suggestions.
std::vector<std::string> keys_with_reason();

}  // namespace latsch::formats
