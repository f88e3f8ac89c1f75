// SPDX-License-Identifier: Apache-2.0
// Finds all descendants of a process in /proc: kills them, or sums up what they have used.
//
// A process that became independent of its parents (its parent ended first) is not found. If an
// outside program does so, it ends with the process group of its worker at the latest.
#pragma once

#include <sys/types.h>

namespace latsch {

/// Kills all descendants of `root`, a child of this process. The root must be stopped, or it can
/// start other processes meanwhile. This function does not stop the root itself: if this process
/// were killed in between, the stopped worker could not react to the death of its parent and would
/// stay forever.
void kill_descendants(pid_t root);

/// The use of the machine by a process and its descendants.
struct ProcessUse {
  /// User and system time, s, including that of children that have ended.
  double processor_time = 0.0;
  bool is_held_up = false;  // true if a process computes or waits for a processor or a disk
};

/// Returns the use by a process and its descendants; zero if the process has ended.
ProcessUse use_of_tree(pid_t root);

}  // namespace latsch
