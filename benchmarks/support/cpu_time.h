// SPDX-License-Identifier: Apache-2.0
// Processor time, which other programs disturb less than wall time.
#pragma once

#include <sys/resource.h>

namespace latsch::benchmarks {

/// Returns the CPU time of the program since its start, s, user and system; with `who`
/// RUSAGE_CHILDREN that of its ended child processes.
double cpu_seconds(int who = RUSAGE_SELF);

}  // namespace latsch::benchmarks
