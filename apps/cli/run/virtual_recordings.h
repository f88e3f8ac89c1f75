// SPDX-License-Identifier: Apache-2.0
// Records what a study measures on a model in place of a laboratory, before the study is read
// (correlation/laboratory/virtual_recording.h).
#pragma once

#include <filesystem>
#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Makes the virtual recordings of a study that are missing or out of date, and says so. Throws
/// InputError if a test gives no recording, and in one of several processes.
void make_recordings(const std::filesystem::path& study, const experiment::Language& language);

/// Says that a recording is up to date, and returns false, if there is no reason `why` to make it;
/// otherwise says that it is made, and returns true. A file whose values have been changed is kept
/// beside it as FILE.changed.
bool begin_recording(const std::filesystem::path& file,
                     const std::string& in_words,
                     const std::string& why);

}  // namespace latsch::cli
