// SPDX-License-Identifier: Apache-2.0
// Processor time, which other programs disturb less than wall time.
#pragma once

#include <sys/resource.h>

namespace latsch::benchmarks {

/// Returns s, user and system, since the program's start; with `who` RUSAGE_CHILDREN those of ended
/// children.
double cpu_seconds(int who = RUSAGE_SELF);

}  // namespace latsch::benchmarks
