// SPDX-License-Identifier: Apache-2.0
// The worker's side of a ProcessExecutor: a program started as a worker builds its evaluator and
// calls serve().
#pragma once

#include "evaluation/trial/evaluator.h"

namespace latsch {

/// File descriptors between ProcessExecutor and its worker; 0, 1 and 2 stay free for printed
/// output.
inline constexpr int kWorkerInput = 3;
inline constexpr int kWorkerOutput = 4;

/// Evaluates points until the other side closes; returns the program's exit code. Ends when the
/// process that started it ends.
int serve(const Evaluator& evaluator, int in_fd = kWorkerInput, int out_fd = kWorkerOutput);

}  // namespace latsch
