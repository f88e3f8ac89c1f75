// SPDX-License-Identifier: Apache-2.0
// Time as an argument, and processor time. Code that measures time or waits takes a Clock, so that
// a test can supply a clock that it controls.
#pragma once

#include <time.h>

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

/// Returns the processor time of this thread, in seconds.
inline double thread_cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace latsch
