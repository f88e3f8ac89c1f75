// SPDX-License-Identifier: Apache-2.0
// Handles Ctrl-C and SIGTERM: the first signal requests the run to stop, the second one ends the
// program at once. If the run does not respond within two seconds, because it reads a large
// journal, computes a step, or writes to a pipe that nobody reads, the program ends; the journal
// survives this.
#pragma once

namespace latsch::cli {

/// Catches interrupt signals from this call on.
void catch_interrupts();
/// True if a signal has arrived since catch_interrupts().
bool interrupted();

}  // namespace latsch::cli
