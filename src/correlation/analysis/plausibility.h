// SPDX-License-Identifier: Apache-2.0
// Checks that the numbers of a study can be those of a tire: by the usual range of each quantity
// (experiment/language/usual_numbers.h), and by rules that compare a measurement with the tire it
// was made on.
//
// Units have been checked before (a pressure is a pressure), but magnitudes have not: 240 bar for
// 240 kPa, kN read as N, the density of air, a deflection deeper than the section is high. An
// unusual number may be intended and is a warning; a number that no tire has is impossible. The
// checks also find numbers that two variables set, and modes and experiments that are stated twice.
//
// The ranges cover tires from a bicycle's to an earthmover's; they are orders of magnitude, not
// tolerances. A wrong number of a plausible size is not detected.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "correlation/study/study.h"
#include "experiment/language/usual_numbers.h"

namespace latsch::correlation {

using experiment::Finding;

/// Returns findings in the order of model, study, measurements. Reads the files of the model, the
/// study and the measurements once more to find the line numbers.
std::vector<Finding> implausible(const Study& study);

}  // namespace latsch::correlation
