// SPDX-License-Identifier: Apache-2.0
// The inflation pressure of the tire in a test.
//
// The keys are in experiment/tests/keys/pressure_keys.cpp.
#pragma once

#include <string>

#include "base/document.h"
#include "experiment/rigs/measured_conditions.h"
#include "models/tire/rolls.h"

namespace latsch::experiment {

/// Reads the key. Throws InputError.
Inflation read_pressure(const Node& test, const MeasuredConditions& measured = {});

/// Returns the end of a test's description: ", 2.6 bar", or "" for the tire's own pressure.
std::string inflated(const Inflation& pressure);

}  // namespace latsch::experiment
