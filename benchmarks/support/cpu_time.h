// SPDX-License-Identifier: Apache-2.0
// Processor time, which other programs beside a benchmark disturb less than that on the wall.
#pragma once

#include <sys/resource.h>

namespace latsch::benchmarks {

/// s, of the user and the system, since the program's start; `who`: RUSAGE_CHILDREN those it has
/// waited for.
double cpu_seconds(int who = RUSAGE_SELF);

}  // namespace latsch::benchmarks
