// SPDX-License-Identifier: Apache-2.0
// Texts and keys as TOML writes them.
#pragma once

#include <string>
#include <string_view>

namespace latsch {

/// The text in quotes, with quotes, backslashes, line ends and tabs escaped.
std::string toml_text(std::string_view text);

/// A key as it stands before "=": bare if it may be, else in quotes.
std::string toml_key(std::string_view key);

}  // namespace latsch
