// SPDX-License-Identifier: Apache-2.0
// Texts and keys as TOML writes them.
#pragma once

#include <string>
#include <string_view>

namespace latsch {

/// Returns the text in quotes, with quotes, backslashes, line ends and tabs escaped.
std::string toml_text(std::string_view text);

/// Returns a key as written before "=": bare if TOML allows it, else in quotes.
std::string toml_key(std::string_view key);

}  // namespace latsch
