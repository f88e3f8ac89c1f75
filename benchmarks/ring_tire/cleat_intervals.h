// SPDX-License-Identifier: Apache-2.0
// Number of intervals of studies/cleat_fit that contain the specimen's number: the study as
// shipped, run by the program, with no knowledge except its bounds.
#pragma once

#include "table.h"

namespace latsch::benchmarks::cleat {

/// Adds a row for each draw of the noise: the study's own measurements first, then others of the
/// same specimen.
void count_intervals(int draws, Table& table);

}  // namespace latsch::benchmarks::cleat
