// SPDX-License-Identifier: Apache-2.0
// Detects numbers of a study that no tire has, before trials are spent on them.
#pragma once

#include "correlation/study/study.h"

namespace latsch::cli {

/// Warns of unusual numbers. Throws InputError for the first impossible one, after all warnings.
void reject_implausible(const correlation::Study& study);

}  // namespace latsch::cli
