// SPDX-License-Identifier: Apache-2.0
// Time as an argument: code that measures time or waits takes a Clock, so that a test can supply a
// clock that it controls.
#pragma once

#include <chrono>
#include <functional>

namespace latsch {

/// Seconds since a fixed moment. A Clock never runs backward, even if the date is changed.
using Clock = std::function<double()>;

/// Returns the clock of the machine, in seconds since an arbitrary moment.
inline Clock steady_clock() {
  return [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
}

}  // namespace latsch
