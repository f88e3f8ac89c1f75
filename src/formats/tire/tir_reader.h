// SPDX-License-Identifier: Apache-2.0
// From the sections of a .tir to parameters in SI, with what is odd, assumed or not used.
#pragma once

#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Fills everything but `source`, which is there. InputError naming file and line.
void read_parameters(TirFile& tir);

/// The SI value of 1 in the units of a file.
double si_factor(magic_formula::ParameterUnit unit, const TeimOrbitUnits& units);

/// A section whose keys are units or words about the file.
bool holds_no_parameters(const TeimOrbitSection& section);

}  // namespace latsch::formats
