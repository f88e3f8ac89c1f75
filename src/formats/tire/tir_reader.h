// SPDX-License-Identifier: Apache-2.0
// Converts the sections of a .tir to parameters in SI, and records odd, assumed and unused keys.
#pragma once

#include "formats/tire/tir_file.h"

namespace latsch::formats {

/// Fills all members except `source`, which must have been set. Throws InputError that names file
/// and line.
void read_parameters(TirFile& tir);

/// Returns the SI value of one unit of the file for a kind of parameter.
double si_factor(magic_formula::ParameterUnit unit, const TeimOrbitUnits& units);

/// True for a section whose keys are units or describe the file.
bool holds_no_parameters(const TeimOrbitSection& section);

}  // namespace latsch::formats
