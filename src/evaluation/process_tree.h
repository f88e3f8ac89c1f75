// SPDX-License-Identifier: Apache-2.0
// A process and all that descends from it, as the system lists them in /proc.
//
// A process that made itself independent of its parents (its parent ended before it) is not found;
// an outside program that does so ends with the process group of its worker at the latest.
#pragma once

#include <sys/types.h>

namespace latsch {

/// Kills the process, a child of this one, and its descendants; none can start another meanwhile.
/// The child itself still has to be waited for.
void kill_tree(pid_t root);

}  // namespace latsch
