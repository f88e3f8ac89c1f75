// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM: the first asks the run to stop, the second ends the program at once. What
// cannot be asked just now (it reads a large journal, computes a step, writes to a pipe that nobody
// reads) is ended after two seconds; the journal stands that.
#pragma once

namespace latsch::cli {

/// From now on signals are caught.
void catch_interrupts();
/// Whether one has come.
bool interrupted();

}  // namespace latsch::cli
