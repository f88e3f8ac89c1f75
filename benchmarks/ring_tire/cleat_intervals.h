// SPDX-License-Identifier: Apache-2.0
// Counts the intervals of studies/cleat_fit that contain the specimen's true parameter. The study
// is run by the program as shipped, and knows the parameters only by their bounds.
#pragma once

#include "table.h"

namespace latsch::benchmarks::cleat {

/// Adds a row for each draw of the noise: the study's own measurements first, then others of the
/// same specimen.
void count_intervals(int draws, Table& table);

}  // namespace latsch::benchmarks::cleat
