// SPDX-License-Identifier: Apache-2.0
// A tire file whose columns of elements end where they are told to, and how many sectors it has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace latsch::cli {

/// "columns = [0, 0.1, 1]", as a line of [mesh].
std::string columns_line(const std::vector<double>& columns);

/// The tire file `text` with that line in place of what told its columns, and so many sectors.
/// Throws InputError with the lines to write by hand where the file is written in another way than
/// expected.
std::string placed_tire(std::string_view text, const std::vector<double>& columns, int sectors);

}  // namespace latsch::cli
