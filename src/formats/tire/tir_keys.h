// SPDX-License-Identifier: Apache-2.0
// Keys of .tir files that change no force here, each with the reason.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace latsch::formats {

/// Why a key is read and not used.
struct TirReason {
  std::string text;
  /// The program that the key is made for computes something with it: a user who expects that has
  /// to be told, not only on request.
  bool told = false;
};

/// Nothing where the key (in capitals) is a coefficient that acts, or is not known at all.
/// `value`: as the file has it; a key whose value says "off" needs no telling.
std::optional<TirReason> reason_unused(std::string_view key, std::string_view value);

/// What a parameter that acts only in some models or modes acts in; "" where it always does.
std::string_view acts_only(std::string_view parameter);

/// Keys with a reason, for suggestions.
std::vector<std::string> keys_with_reason();

}  // namespace latsch::formats
