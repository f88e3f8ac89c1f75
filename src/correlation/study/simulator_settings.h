// SPDX-License-Identifier: Apache-2.0
// [simulator] in a study, instead of `model`: an outside program evaluates the points. The keys are
// in correlation/study/keys/simulator_keys.cpp.
#pragma once

#include <filesystem>

#include "base/document.h"
#include "evaluation/outside_program/simulator.h"

namespace latsch::correlation {

/// Reads a variable that fills placeholders in input files.
DesignVariable read_free_variable(const Node& table);

/// Reads [simulator]. Throws InputError, also for a variable that fills no placeholder.
Simulator read_simulator(const Node& table,
                         const std::filesystem::path& study,
                         const DesignSpace& space);

}  // namespace latsch::correlation
