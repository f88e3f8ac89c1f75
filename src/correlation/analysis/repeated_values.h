// SPDX-License-Identifier: Apache-2.0
// Finds measured values that a study fits more than once. They count twice, and the intervals of a
// fit are then narrower than the values allow: a table that two experiments name, which a weight
// would express better, and samples of one file that two [measurement.NAME] select.
#pragma once

#include <vector>

#include "base/document.h"
#include "correlation/study/study.h"
#include "experiment/language/usual_numbers.h"

namespace latsch::correlation {

/// Returns a finding for every such pair of experiments; a note for samples of one file. `file` is
/// that of the study.
std::vector<experiment::Finding> repeated_values(const Study& study, const Document& file);

}  // namespace latsch::correlation
