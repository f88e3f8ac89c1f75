// SPDX-License-Identifier: Apache-2.0
// Finds all descendants of a process in /proc.
//
// A process that became independent of its parents (its parent ended first) is not found. If an
// outside program does so, it ends with the process group of its worker at the latest.
#pragma once

#include <sys/types.h>

namespace latsch {

/// Kills all descendants of `root`, a child of this process. Unless the root is stopped, it can
/// start others meanwhile. The root itself is not touched: if it were stopped, and this process
/// were killed before killing it, the worker could not react to the death of its parent and would
/// stay forever.
void kill_descendants(pid_t root);

}  // namespace latsch
