// SPDX-License-Identifier: Apache-2.0
// The program for any set of models and tests. To add a model, write its kind, add it to a table of
// the shipped ones (experiment/language.cpp) and write a main() of one line: the program is its own
// worker, so that fits, designs and intervals run in many processes.
#pragma once

#include "experiment/language.h"

namespace latsch::cli {

/// Runs the whole command line and returns the exit code (verbs/verbs.h). Never throws.
int run_cli(int argc, char** argv, const experiment::Language& language);

}  // namespace latsch::cli
