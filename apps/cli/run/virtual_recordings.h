// SPDX-License-Identifier: Apache-2.0
// Records what a study measures on a model in place of a laboratory, before the study is read
// (correlation/laboratory/virtual_recording.h).
#pragma once

#include <filesystem>

#include "experiment/language.h"

namespace latsch::cli {

/// Makes the virtual recordings of a study that are missing or out of date, and says so. Throws
/// InputError if a test gives no recording, and in one of several processes.
void make_recordings(const std::filesystem::path& study, const experiment::Language& language);

}  // namespace latsch::cli
