// SPDX-License-Identifier: Apache-2.0
// Reads a test that the user names on the command line: a file, or its keys in braces.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Returns the test of a file, or of a text of its keys in braces, together with the names of the
/// files that it opens. Throws InputError, also for numbers that no tire has.
experiment::ReadTest test_argument(const std::string& text, const experiment::Language& language);

}  // namespace latsch::cli
