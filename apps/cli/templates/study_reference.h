// SPDX-License-Identifier: Apache-2.0
// docs/study_reference.md, contained in the program; tools/study_reference.py makes it from the
// readers.
#pragma once

#include <string_view>

namespace latsch::cli {

std::string_view study_reference();

}  // namespace latsch::cli
