// SPDX-License-Identifier: Apache-2.0
// Converts a .tir into a tree of numbers in SI, each under its own name ("PKY1",
// "UNLOADED_RADIUS"), and back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "models/magic_formula/parameters.h"

namespace latsch::experiment {

/// Returns every finite parameter, and version, side, use mode and the load curve. Throws
/// InputError as formats::read_tir does.
Document read_tir_numbers(const std::filesystem::path& file);
/// Says what was left out of the file or assumed for it, one sentence each; also if the file states
/// no side.
std::vector<std::string> tir_notes(const std::filesystem::path& file);
/// Returns the side of a car on which such a tire is itself and not its mirror image: "of the left
/// side".
std::string side_in_words(const Document& numbers);

/// Throws InputError if a number that the tire needs is not positive.
magic_formula::Parameters parameters_of(const Document& numbers);

std::string tir_text_of(const Document& numbers);

}  // namespace latsch::experiment
