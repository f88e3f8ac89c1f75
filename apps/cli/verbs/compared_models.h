// SPDX-License-Identifier: Apache-2.0
// latsch compare of models through grids of tests (correlation/comparison/model_comparison.h).
#pragma once

#include <filesystem>
#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// With a folder for measurements: writes what the reference shows, a file a case, and ends.
void compare_models(const std::string& name,
                    const experiment::Language& language,
                    const std::filesystem::path& measurements,
                    const std::string& output,
                    int threads);

}  // namespace latsch::cli
