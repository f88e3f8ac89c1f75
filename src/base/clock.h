// SPDX-License-Identifier: Apache-2.0
// Time as an argument: what measures or waits takes a Clock, and a test gives it a time of its own.
#pragma once

#include <chrono>
#include <functional>

namespace latsch {

/// Seconds since some moment; never runs backward, whatever happens to the date.
using Clock = std::function<double()>;

inline Clock steady_clock() {
  return [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
}

}  // namespace latsch
