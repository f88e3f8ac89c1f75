// SPDX-License-Identifier: Apache-2.0
// The unit of measured times, which makes figures of different processors comparable: the same run
// also measures an arc tangent of the C library, a fused multiply-add or a stream of memory, in
// turn with the measured code.
#pragma once

#include <functional>
#include <string>

namespace latsch::benchmarks {

/// Returns the processor time of this process, s.
double cpu_time();

enum class Yardstick {
  atan,          // std::atan of the C library, of one number
  multiply_add,  // a fused multiply-add of one lane, with the kernel set in use
  byte,          // a byte read from one array and written to another, both beyond the caches
};

/// CPU seconds of a run and of one yardstick, each the least of several rounds in which both take
/// turns: other work on the machine cannot shorten either.
struct Beside {
  double time, yardstick;
  double ratio() const { return time / yardstick; }
  Beside per(double count) const { return {time / count, yardstick}; }
};
Beside beside(Yardstick yardstick, int rounds, const std::function<void()>& run);

/// Returns for example "31.2 atan (0.296 us)".
std::string in_units(const Beside& cost, Yardstick yardstick);
/// Returns for example 0.296 us or 12.3 ns.
std::string as_time(double seconds);

}  // namespace latsch::benchmarks
