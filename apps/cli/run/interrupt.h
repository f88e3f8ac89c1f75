// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM: the first one asks the run to stop, the second one ends the program at once.
// If the run does not respond (it reads a large journal, computes a step, writes to a pipe that
// nobody reads) the program ends after two seconds; the journal survives this.
#pragma once

namespace latsch::cli {

/// Catches signals from now on.
void catch_interrupts();
/// True if a signal has arrived.
bool interrupted();

}  // namespace latsch::cli
