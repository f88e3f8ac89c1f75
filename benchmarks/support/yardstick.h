// SPDX-License-Identifier: Apache-2.0
// What times are measured in, so that a figure of one processor says something of another: the
// same run also measures an arc tangent of the C library, a fused multiply-add or a stream of
// memory, in turn with what is measured.
#pragma once

#include <functional>
#include <string>

namespace latsch::benchmarks {

/// s, of this process.
double cpu_time();

enum class Yardstick {
  atan,          // std::atan of the C library, of one number
  multiply_add,  // a fused multiply-add of one lane, of the kernel set in use
  byte,          // read from one array and written to another, both beyond the caches
};

/// CPU seconds of a run and of one yardstick, each the least of several rounds in which both take
/// their turn: other work on the machine makes neither shorter.
struct Beside {
  double time, yardstick;
  double ratio() const { return time / yardstick; }
  Beside per(double count) const { return {time / count, yardstick}; }
};
Beside beside(Yardstick yardstick, int rounds, const std::function<void()>& run);

/// "31.2 atan (0.296 us)"
std::string in_units(const Beside& cost, Yardstick yardstick);
/// 0.296 us, 12.3 ns ...
std::string as_time(double seconds);

}  // namespace latsch::benchmarks
