// SPDX-License-Identifier: Apache-2.0
// The bound of what has none, and the value of what failed.
#pragma once

#include <limits>

namespace latsch {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace latsch
