// SPDX-License-Identifier: Apache-2.0
// Writes one table of a document as TOML of its own, with the numbers that it has now. Comments and
// the order of lines between tables are lost; tables inside the table are written in braces.
#pragma once

#include <string>
#include <vector>

#include "base/document.h"

namespace latsch::experiment {

/// Returns a line `key = value` for every entry of the table that is not in `without`.
std::string text_of_table(const Node& table, const std::vector<std::string>& without = {});

}  // namespace latsch::experiment
