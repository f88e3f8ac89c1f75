// SPDX-License-Identifier: Apache-2.0
// The frequencies of the tests "response" and "rolling_response". Their keys are those of
// experiment/tests/keys/frequency_keys.cpp.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "experiment/language/test.h"

namespace latsch::experiment {

/// Reads ascending frequencies, Hz, at most `highest`. `why` says why none may be higher: "shorter
/// waves than a mesh of a tire carries". Throws InputError, which names file, line and key.
std::vector<double> read_frequencies(const Node& root,
                                     const TestSource& source,
                                     double highest,
                                     const char* why);

}  // namespace latsch::experiment
