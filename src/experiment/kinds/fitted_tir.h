// SPDX-License-Identifier: Apache-2.0
// Writes a .tir that states the origin of every value and limits its inputs to the data.
//
// Every value is followed by one of
//   fitted -32.1 +- 0.4 (95 %)     fitted by the study, as stated in Provenance::origins
//   kept from tire.tir             stated in the study's model file; with the comment of that file
//   assumed, ...                   not stated in the model file, or stated there as assumed
// The RANGE sections of slips, camber, load and pressure extend from the least to the greatest
// value in the tests of the fitted experiments, without a margin. A condition that the data do not
// vary gets no range: a tire measured at one camber would otherwise be clamped to it. The limits of
// the model file also hold in the fit, so the ranges never go beyond them. A .tir has no range of
// speed; the speeds are in a comment at LONGVL.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/document.h"
#include "experiment/language/provenance.h"

namespace latsch::experiment {

/// Throws InputError if the numbers make no tire. Reading the text returns the same numbers to the
/// last bit, except for the ranges.
std::string fitted_tir_text(const Document& numbers, const Provenance& provenance);

/// Returns the coefficients with a known value: those in `fitted`, and those that the model file
/// states without the remark "assumed". A file that can no longer be read states none.
std::set<std::string> known_coefficients(const std::filesystem::path& model_file,
                                         const std::vector<std::string>& fitted);

}  // namespace latsch::experiment
