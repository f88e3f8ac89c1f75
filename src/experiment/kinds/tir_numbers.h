// SPDX-License-Identifier: Apache-2.0
// Converts a .tir into a tree of numbers in SI, each under its own name ("PKY1",
// "UNLOADED_RADIUS"), and back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/language/known_limits.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/inflation.h"
#include "models/magic_formula/parameters.h"
#include "models/magic_formula/tree/parameter_tree.h"

namespace latsch::experiment {

/// Returns every finite parameter, and version, side, use mode and the load curve. Throws
/// InputError as formats::read_tir does.
Document read_tir_numbers(const std::filesystem::path& file);
/// Returns what reading left out of the file or assumed for it, one sentence each; also if the file
/// states no side of the car.
std::vector<std::string> tir_notes(const std::filesystem::path& file);
/// Returns the side of the car for which the file describes the tire itself and not its mirror
/// image: "of the left side".
std::string side_in_words(const Document& numbers);

using magic_formula::parameters_of;

/// Returns a sentence for every range of the file that a wheel driven like this leaves; the forces
/// of the test are those at the end of the range wherever it does.
std::vector<std::string> limits_when_driven_of(const magic_formula::Parameters& parameters,
                                               const DrivenWheel& driven);

/// Returns the height of the section, m; nullopt if the file states no RIM_RADIUS.
std::optional<double> section_height_of(const magic_formula::Parameters& parameters);
/// Returns half of WIDTH, m; nullopt if the file states none.
std::optional<double> tread_half_width_of(const magic_formula::Parameters& parameters);
/// Returns the free radius and the height of the section; nullopt without RIM_RADIUS.
std::optional<SpecimenKind::Size> tir_size(const Document& numbers);
/// Returns a sentence on why a tire that stands still has no stiffness in a direction
/// (KnowsLimits::no_stiffness), and on the value assumed for it.
std::string no_stiffness_of(const magic_formula::Parameters& parameters,
                            const std::string& direction);
std::string assumed_stiffness_of(const magic_formula::Parameters& parameters,
                                 const std::string& direction);

/// Returns a sentence if a .tir cannot distinguish conicity from ply steer
/// (KnowsLimits::limits_backward); none if the tire has no side force at zero slip angle.
std::vector<std::string> limits_backward_of(const magic_formula::Parameters& parameters);

/// Returns a sentence that says that camber does not change the contact patch of a standing tire
/// (KnowsLimits::limits_at_camber).
std::vector<std::string> upright_footprint(bool rolls);

/// Returns the text of a new file with these numbers and with those parts of their old file that
/// have no effect in Latsch (formats/tire/kept_parts.h).
std::string tir_text_of(const Document& numbers);

/// Returns the text together with the parts of the original file that have no effect, if that file
/// can be read.
std::string with_parts_of(const std::filesystem::path& file, const std::string& text);

}  // namespace latsch::experiment
