// SPDX-License-Identifier: Apache-2.0
// All that descends from a process, as the system lists it in /proc.
//
// A process that made itself independent of its parents (its parent ended before it) is not found;
// an outside program that does so ends with the process group of its worker at the latest.
#pragma once

#include <sys/types.h>

namespace latsch {

/// Kills all that descends from `root`, a child of this process; unless the root is stopped it can
/// start others meanwhile. The root itself is not touched: stopped and not yet killed when this
/// process is killed, a worker could not act on the death of its parent and would stay for ever.
void kill_descendants(pid_t root);

}  // namespace latsch
