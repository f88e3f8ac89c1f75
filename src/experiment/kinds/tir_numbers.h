// SPDX-License-Identifier: Apache-2.0
// A .tir as a tree of numbers in SI, each under its own name ("PKY1", "UNLOADED_RADIUS"), and back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "models/magic_formula/parameters.h"

namespace latsch::experiment {

/// Every parameter that is finite; version, side, use mode and the load curve besides. InputError
/// as formats::read_tir.
Document read_tir_numbers(const std::filesystem::path& file);
/// What of the file was left out or assumed, a sentence each; also where it states no side.
std::vector<std::string> tir_notes(const std::filesystem::path& file);
/// "of the left side": on which side of a car such a tire is itself, and not its mirror image.
std::string side_in_words(const Document& numbers);

/// InputError where a number the tire cannot do without is not positive.
magic_formula::Parameters parameters_of(const Document& numbers);

std::string tir_text_of(const Document& numbers);

}  // namespace latsch::experiment
