// SPDX-License-Identifier: Apache-2.0
// The bound of a variable without bounds, and the value of a failed evaluation.
#pragma once

#include <limits>

namespace latsch {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace latsch
