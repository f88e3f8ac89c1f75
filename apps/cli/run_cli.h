// SPDX-License-Identifier: Apache-2.0
// The program, for whatever models and tests there are. A model of one's own is its kind in a table
// beside those of the shipped ones (experiment/language.cpp) and a main() of one line: the program
// is its own worker, so that fits, designs and intervals run it on many processes.
#pragma once

#include "experiment/language.h"

namespace latsch::cli {

/// The whole command line, until the exit code (verbs/verbs.h). Never throws.
int run_cli(int argc, char** argv, const experiment::Language& language);

}  // namespace latsch::cli
