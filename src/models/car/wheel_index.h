// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace latsch::car {

/// Returns the number of a wheel or corner as the index of a container.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace latsch::car
