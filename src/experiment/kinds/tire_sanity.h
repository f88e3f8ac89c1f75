// SPDX-License-Identifier: Apache-2.0
// Sanity of a Magic Formula tire beyond its data (models/magic_formula/sanity.h), for numbers as a
// .tir or a study has them.
#pragma once

#include <vector>

#include "experiment/language/specimen.h"

namespace latsch::experiment {

/// Over the values of Fz, kappa, alpha, gamma and p; a null function: over the ranges of the file,
/// or usual ones. Empty where no load was measured.
std::vector<FaultBeyondData> tire_faults(const Document& numbers, const MeasuredAt& values_of);

}  // namespace latsch::experiment
