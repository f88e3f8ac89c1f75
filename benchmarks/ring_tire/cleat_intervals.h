// SPDX-License-Identifier: Apache-2.0
// How many intervals of studies/cleat_fit hold the specimen's number: the study as it ships, run by
// the program, nothing known before but its bounds.
#pragma once

#include "table.h"

namespace latsch::benchmarks::cleat {

/// A row a draw of the noise: the study's own measurements first, then others of the same specimen.
void count_intervals(int draws, Table& table);

}  // namespace latsch::benchmarks::cleat
