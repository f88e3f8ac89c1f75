// SPDX-License-Identifier: Apache-2.0
#include "yardstick.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>
#include <vector>

#define LATSCH_KERNELS_IN "yardstick_kernels.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::benchmarks {
namespace {

/// Receives results of timed loops, so that the compiler does not remove the loops.
volatile double sink;

double time_of_atan() {
  constexpr int kCount = 20000;
  const double start = cpu_time();
  double sum = 0.0;
  for (int i = 0; i < kCount; ++i) sum += std::atan(1e-3 * i - 10.0);
  sink = sum;
  return (cpu_time() - start) / kCount;
}

double time_of_multiply_add() {
  constexpr int kCount = 20000;
  const double start = cpu_time();
  sink = LATSCH_KERNEL(multiply_add)(kCount, 0.999);
  return (cpu_time() - start) / (64.0 * kCount);
}

double time_of_byte() {
  constexpr std::size_t kBytes = 64 << 20;
  static std::vector<char> from(kBytes, 1), to(kBytes);
  const double start = cpu_time();
  std::memcpy(to.data(), from.data(), kBytes);
  sink = to[kBytes / 2];
  return (cpu_time() - start) / kBytes;
}

double time_of(Yardstick yardstick) {
  switch (yardstick) {
    case Yardstick::atan:
      return time_of_atan();
    case Yardstick::multiply_add:
      return time_of_multiply_add();
    case Yardstick::byte:
      break;
  }
  return time_of_byte();
}

std::string_view name(Yardstick yardstick) {
  switch (yardstick) {
    case Yardstick::atan:
      return "atan";
    case Yardstick::multiply_add:
      return "multiply-adds";
    case Yardstick::byte:
      break;
  }
  return "bytes";
}

}  // namespace

double cpu_time() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Beside beside(Yardstick yardstick, int rounds, const std::function<void()>& run) {
  Beside least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int i = 0; i < rounds; ++i) {
    least.yardstick = std::min(least.yardstick, time_of(yardstick));
    const double start = cpu_time();
    run();
    least.time = std::min(least.time, cpu_time() - start);
  }
  return least;
}

std::string as_time(double seconds) {
  if (seconds < 1e-7) return fmt::format("{:.3g} ns", seconds * 1e9);
  if (seconds < 1e-4) return fmt::format("{:.3g} us", seconds * 1e6);
  return seconds < 0.1 ? fmt::format("{:.3g} ms", seconds * 1e3) : fmt::format("{:.3g} s", seconds);
}

std::string in_units(const Beside& cost, Yardstick yardstick) {
  return fmt::format("{:.3g} {} ({})", cost.ratio(), name(yardstick), as_time(cost.time));
}

}  // namespace latsch::benchmarks
