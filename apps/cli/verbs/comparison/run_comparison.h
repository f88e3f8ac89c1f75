// SPDX-License-Identifier: Apache-2.0
// Implements `latsch run` for a comparison of models: its virtual recordings, its fits, then the
// comparison itself, in one command.
#pragma once

#include <functional>
#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Runs every study that a table [fit.NAME] names by `fit`, which returns an exit code, records the
/// virtual reference if it is missing or out of date, and compares the models. A fit that has
/// finished and has not changed is not searched again. Returns the exit code of the first fit that
/// did not end well, or that of success. With `records_only` it ends after the recordings, and the
/// function `fit` is expected to do so, too.
int run_comparison(const std::string& name,
                   const experiment::Language& language,
                   bool records_only,
                   const std::function<int(const std::string& study)>& fit);

}  // namespace latsch::cli
