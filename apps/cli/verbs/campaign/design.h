// SPDX-License-Identifier: Apache-2.0
// The verb `latsch design`: chooses the settings of the tests that a laboratory makes next.
#pragma once

#include "cli/verbs/verbs.h"

namespace latsch::cli {

void add_design(CommandLine& app, Program& program);

}  // namespace latsch::cli
