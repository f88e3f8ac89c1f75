// SPDX-License-Identifier: Apache-2.0
// Implements `latsch compare` for models, over grids of tests
// (correlation/comparison/model_comparison.h).
#pragma once

#include <filesystem>
#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Records the cases of a virtual reference whose recordings are missing or out of date.
void record_reference(const std::string& name, const experiment::Language& language);

/// Compares the models and prints the results. If `measurements` names a folder, writes the results
/// of the reference model instead, one file for each case.
void compare_models(const std::string& name,
                    const experiment::Language& language,
                    const std::filesystem::path& measurements,
                    const std::string& output,
                    int threads);

}  // namespace latsch::cli
