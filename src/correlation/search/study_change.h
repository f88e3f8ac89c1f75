// SPDX-License-Identifier: Apache-2.0
// Compares a study as a run has read it with its files as they are now. A run takes hours, and
// somebody may edit its model or a measurement meanwhile. The run continues with what it has read,
// but its result does not belong to the edited files.
#pragma once

#include <optional>
#include <string>

#include "correlation/study/study.h"
#include "experiment/language.h"

namespace latsch::correlation {

/// Returns in words how the study's files now differ from the study as it was read, in anything on
/// which its trials, its search or its result depend; nullopt if they do not differ.
std::optional<std::string> change_since_read(const Study& study,
                                             const experiment::Language& language);

}  // namespace latsch::correlation
