// SPDX-License-Identifier: Apache-2.0
// Replaces the positions of the element columns and the number of sectors in the text of a tire
// file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch::cli {

/// Returns the line "columns = [0, 0.1, 1]" for the section [mesh] of a tire file.
std::string columns_line(const std::vector<double>& columns);

/// Returns the tire file `text` with these columns instead of its own and with this number of
/// sectors. If the file has another layout than expected, throws InputError that states the lines
/// to write by hand.
std::string placed_tire(std::string_view text, const std::vector<double>& columns, int sectors);

}  // namespace latsch::cli
