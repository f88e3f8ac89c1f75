// SPDX-License-Identifier: Apache-2.0
// Reads version 5 of MAT files from bytes: nested elements of a type, a length and contents.
#pragma once

#include <string>
#include <string_view>

#include "formats/tables/mat_file.h"

namespace latsch::formats {

/// Adds the contents of `bytes` to `file`. Throws InputError.
void read_mat_v5(std::string_view bytes, MatFile& file);

}  // namespace latsch::formats
