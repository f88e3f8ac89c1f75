// SPDX-License-Identifier: Apache-2.0
// Limits of the steps of a test in time, so that every test ends and every count of its steps is an
// integer.
#pragma once

#include <string_view>

#include "base/document.h"

namespace latsch::experiment {

/// Shortest step, s. Differences of positions in shorter steps are rounding.
inline constexpr double kShortestStep = 1e-6;

/// Throws InputError about a key of the test if `seconds`, which the key states, hold more steps of
/// `step` s than a test may have: an hour in steps of 0.18 ms. More would take days.
void check_duration(const Node& test, std::string_view key, double seconds, double step);

}  // namespace latsch::experiment
