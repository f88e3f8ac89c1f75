// SPDX-License-Identifier: Apache-2.0
// Runs shell commands of a benchmark and reports their output if they fail.
#pragma once

#include <string>

namespace latsch::benchmarks {

/// Everything that a command printed.
struct Printed {
  std::string output;  // to standard output
  std::string errors;  // to standard error
};

/// Runs a shell command to its end. If it fails, throws std::runtime_error with the command, its
/// exit code or signal, and the last lines it printed to both.
Printed run_command(const std::string& command);

}  // namespace latsch::benchmarks
