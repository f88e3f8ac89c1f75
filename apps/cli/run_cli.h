// SPDX-License-Identifier: Apache-2.0
// Runs the program with any set of models and tests. To add a model, write its kind, add it to a
// table of the shipped ones (experiment/language.cpp), and write a main() of one line. The program
// also serves as its own worker process, so fits, designs and intervals run in parallel.
#pragma once

#include "experiment/language.h"

namespace latsch::cli {

/// Runs the whole command line and returns the exit code (verbs/verbs.h). Never throws.
int run_cli(int argc, char** argv, const experiment::Language& language);

}  // namespace latsch::cli
