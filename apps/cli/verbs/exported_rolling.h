// SPDX-License-Identifier: Apache-2.0
// Implements `latsch export --vtu FILE --rolling TEST`: writes a finite-element tire that rolls for
// ParaView.
#pragma once

#include <filesystem>
#include <string>

#include "experiment/language.h"

namespace latsch::cli {

/// Rolls the tire of `model`, a model or a study, through the states of `test`, a file or its keys
/// in braces of a test "rolling", "rolling_footprint" or "rolling_chain", and writes the ring, the
/// patch beside it as .patch.vtu and the chains of a rolling_chain as .chain.vtu; of several
/// states, files are numbered from 1. Throws InputError.
void write_rolling_vtu(const std::string& model,
                       const std::string& test,
                       const std::filesystem::path& file,
                       const experiment::Language& language);

}  // namespace latsch::cli
