// SPDX-License-Identifier: Apache-2.0
// Checks whether a Magic Formula tire behaves plausibly beyond its data
// (models/magic_formula/sanity/sanity.h), for numbers from a .tir or a study.
#pragma once

#include <vector>

#include "experiment/language/specimen.h"

namespace latsch::experiment {

/// Checks the tire over the ranges of Fz, kappa, alpha, gamma and p in these values; if the
/// function is null, over the ranges of the file or usual ones. Returns nothing if no load was
/// measured.
std::vector<FaultBeyondData> tire_faults(const Document& numbers, const MeasuredAt& values_of);

}  // namespace latsch::experiment
