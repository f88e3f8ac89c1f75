// SPDX-License-Identifier: Apache-2.0
// The verb `latsch sample`: draws samples of the posterior density of the variables around the best
// trial of a journal.
#pragma once

#include "cli/verbs/verbs.h"

namespace latsch::cli {

void add_sample(CommandLine& app, Program& program);

}  // namespace latsch::cli
