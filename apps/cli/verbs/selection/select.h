// SPDX-License-Identifier: Apache-2.0
// The verb `latsch select`: chooses the variables of a study that its measurements carry.
#pragma once

#include "cli/verbs/verbs.h"

namespace latsch::cli {

void add_select(CommandLine& app, Program& program);

}  // namespace latsch::cli
