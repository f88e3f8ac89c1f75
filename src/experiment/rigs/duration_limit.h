// SPDX-License-Identifier: Apache-2.0
// Limits of the time steps of a test, so that every test ends and the number of its steps is a
// valid integer.
#pragma once

#include <string_view>

#include "base/document.h"

namespace latsch::experiment {

/// Shortest time step, s: in shorter steps, differences of positions are rounding.
inline constexpr double kShortestStep = 1e-6;

/// Throws InputError about a key of the test if `seconds`, which the key states, contains more time
/// steps of `step` s than a test may have: an hour in steps of 0.18 ms. More would take days.
void check_duration(const Node& test, std::string_view key, double seconds, double step);

}  // namespace latsch::experiment
