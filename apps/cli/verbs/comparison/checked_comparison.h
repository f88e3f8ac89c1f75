// SPDX-License-Identifier: Apache-2.0
// Implements `latsch check` for a comparison of models.
#pragma once

#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Reads the comparison with its models, tests and the studies of its fits, and prints what it
/// compares, which recordings are missing or out of date, and which fits have no trials yet. Throws
/// InputError naming the place.
void check_comparison(const std::string& name, const experiment::Language& language);

}  // namespace latsch::cli
