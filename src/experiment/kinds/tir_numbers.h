// SPDX-License-Identifier: Apache-2.0
// Converts a .tir into a tree of numbers in SI, each under its own name ("PKY1",
// "UNLOADED_RADIUS"), and back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/language/specimen.h"
#include "experiment/rigs/inflation.h"
#include "models/magic_formula/limits/range_log.h"
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

/// Returns the height of the section, m; nullopt if the file states no RIM_RADIUS.
std::optional<double> section_height_of(const magic_formula::Parameters& parameters);
/// Returns half of WIDTH, m; nullopt if the file states none.
std::optional<double> tread_half_width_of(const magic_formula::Parameters& parameters);
/// Returns the free radius and the height of the section; nullopt without RIM_RADIUS.
std::optional<SpecimenKind::Size> tir_size(const Document& numbers);
/// Says why a pressure has no effect.
std::string no_pressure_in_words();
/// Returns the ranges of the file that a tire has left, and whether the pressure that a test stated
/// has no effect.
std::vector<std::string> limits_met_by(const magic_formula::Parameters& parameters,
                                       const magic_formula::RangeLog& log,
                                       const Inflation& asked_pressure);

/// Throws InputError at `place` if a tire has no vertical stiffness at this pressure, Pa: its factor
/// 1 + PFZ1 dpi is 0 or negative there.
void refuse_soft_pressure(const magic_formula::Parameters& parameters,
                          double pressure,
                          const Place& place);

/// Says why a standing tire has no stiffness in a direction (KnowsLimits::no_stiffness), and what
/// is assumed for it.
std::string no_stiffness_of(const magic_formula::Parameters& parameters,
                            const std::string& direction);
std::string assumed_stiffness_of(const magic_formula::Parameters& parameters,
                                 const std::string& direction);

/// Says that a .tir does not tell conicity from ply steer (KnowsLimits::limits_backward); empty if
/// the tire has no side force at zero slip angle.
std::vector<std::string> limits_backward_of(const magic_formula::Parameters& parameters);

/// Says that camber does not change the patch of a standing tire (KnowsLimits::limits_at_camber).
std::vector<std::string> upright_footprint(bool rolls);

/// Returns the text of a new file of these numbers, with the parts of their file that have no
/// effect here (formats/tire/kept_parts.h).
std::string tir_text_of(const Document& numbers);

/// Returns the text with those parts of the file, if the file can be read.
std::string with_parts_of(const std::filesystem::path& file, const std::string& text);

}  // namespace latsch::experiment
