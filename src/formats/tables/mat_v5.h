// SPDX-License-Identifier: Apache-2.0
// Parses version 5 of MAT files: nested elements with a type, a length and contents.
#pragma once

#include <string>
#include <string_view>

#include "formats/tables/mat_file.h"

namespace latsch::formats {

/// Adds the variables in `bytes` to `file`. Throws InputError.
void read_mat_v5(std::string_view bytes, MatFile& file);

}  // namespace latsch::formats
