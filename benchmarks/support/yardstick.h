// SPDX-License-Identifier: Apache-2.0
// Units of measured times that make the figures of different processors comparable. A yardstick is
// an operation, such as an arc tangent of the C library, a fused multiply-add or the copy of a
// byte, whose time is measured in the same run, in turn with the measured code.
#pragma once

#include <functional>
#include <string>

namespace latsch::benchmarks {

/// Returns the processor time of this process, s.
double cpu_time();

enum class Yardstick {
  atan,          // std::atan of the C library for one number
  multiply_add,  // one lane of a fused multiply-add, with the kernel set in use
  byte,          // copying one byte between two arrays larger than the caches
};

/// CPU seconds of the measured code and of one yardstick operation. Each is the least of several
/// rounds in which both are measured in turn, because other work on the machine can only lengthen a
/// time.
struct Beside {
  double time, yardstick;
  double ratio() const { return time / yardstick; }
  Beside per(double count) const { return {time / count, yardstick}; }
};
Beside beside(Yardstick yardstick, int rounds, const std::function<void()>& run);

/// Returns the cost in units of the yardstick and in seconds, for example "31.2 atan (0.296 us)".
std::string in_units(const Beside& cost, Yardstick yardstick);
/// Returns the time with a suitable unit, for example "0.296 us" or "12.3 ns".
std::string as_time(double seconds);

}  // namespace latsch::benchmarks
