// SPDX-License-Identifier: Apache-2.0
// Changes the ends of a tire file's columns of elements and its number of sectors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch::cli {

/// Returns "columns = [0, 0.1, 1]", a line of [mesh].
std::string columns_line(const std::vector<double>& columns);

/// Returns the tire file `text` with that line instead of its description of columns, and with that
/// number of sectors. Throws InputError with the lines to write by hand if the file is written in
/// another way than expected.
std::string placed_tire(std::string_view text, const std::vector<double>& columns, int sectors);

}  // namespace latsch::cli
