// SPDX-License-Identifier: Apache-2.0
#include "evaluation/trial/trial.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <exception>
#include <new>

#include "base/clock.h"

namespace latsch {
namespace {

/// Returns the CPU time of the programs that this process has waited for, including the programs
/// that these have waited for.
double program_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Result<Channels> run(const Evaluator& evaluator, const DesignPoint& point) {
  try {
    Result<Channels> result = evaluator(point);
    return result ? finite(std::move(*result)) : std::move(result);
  } catch (const std::bad_alloc&) {
    return Failure{"out of memory"};
  } catch (const std::exception& error) {
    return Failure{error.what()};
  } catch (...) {
    return Failure{"an exception that carries no text"};
  }
}

}  // namespace

Outcome evaluate(const Evaluator& evaluator, const DesignPoint& point) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  // Other threads may evaluate other points.
  const double cpu_start = thread_cpu_seconds(), program_start = program_seconds();
  Outcome outcome{.result = run(evaluator, point)};
  outcome.wall_time = std::chrono::duration<double>(Clock::now() - start).count();
  outcome.cpu_time = thread_cpu_seconds() - cpu_start;
  outcome.program_time = program_seconds() - program_start;
  return outcome;
}

Result<Channels> finite(Channels channels) {
  for (const Channel& channel : channels.all()) {
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      if (std::isfinite(channel.values[i])) continue;
      return Failure{
          fmt::format("channel \"{}\" is {} at sample {}", channel.name, channel.values[i], i + 1),
          Cause::bad_output};
    }
  }
  return channels;
}

}  // namespace latsch
