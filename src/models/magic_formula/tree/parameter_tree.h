// SPDX-License-Identifier: Apache-2.0
// The parameters of the Magic Formula as a tree of numbers in SI, each under its own name ("PKY1",
// "UNLOADED_RADIUS"), as studies vary them and exported units store them.
#pragma once

#include <string>

#include "base/document.h"
#include "models/magic_formula/parameters.h"

namespace latsch::magic_formula {

/// Returns the tree as TOML: every finite parameter, and version, side, use mode and the load
/// curve. parameters_of() gives the same bits back.
std::string tree_text(const Parameters& parameters);

/// Throws InputError if a number that the tire needs is not positive.
Parameters parameters_of(const Document& numbers);

}  // namespace latsch::magic_formula
