// SPDX-License-Identifier: Apache-2.0
// Infinity, used as the bound of a variable without bounds and as the value of a failed evaluation.
#pragma once

#include <limits>

namespace latsch {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace latsch
