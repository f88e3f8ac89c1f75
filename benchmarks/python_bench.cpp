// SPDX-License-Identifier: Apache-2.0
// Time that Python adds to a turn of ask and tell, compared with C++, and to the start of a program
// that imports the module. Both languages run the same search once, which is checked by its last
// point to the bit, and repeat it with the stored outcomes, so that a turn consists only of propose
// and observe. The time is the best of five repetitions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "optimization/strategy/optimizer_choice.h"
#include "table.h"

#ifndef LATSCH_PYTHON
#define LATSCH_PYTHON ""
#define LATSCH_PYTHONPATH ""
#endif

namespace {

using namespace latsch;

constexpr std::size_t kMostTurns = 400;  // see ask_tell_turns.py
constexpr int kRepeats = 5;
constexpr double kMostOverhead = 20e-6;  // s added to each turn
constexpr double kMostImport = 0.2;      // s

std::string output_of(const std::string& arguments) {
  const std::string command =
      "PYTHONPATH=" LATSCH_PYTHONPATH " PYTHONDONTWRITEBYTECODE= " LATSCH_PYTHON " " + arguments;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("python3 cannot be started");
  std::string text;
  std::array<char, 4096> block{};
  while (const std::size_t read = std::fread(block.data(), 1, block.size(), pipe))
    text.append(block.data(), read);
  if (::pclose(pipe) != 0) throw std::runtime_error(command + " failed");
  return text;
}

DesignSpace cube(int n) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = fmt::format("x{}", i), .initial = 0.2});
  return DesignSpace(variables);
}

Score valley(const std::vector<double>& x, bool with_slopes) {
  const std::size_t n = x.size();
  Score score;
  const auto slope = [&](std::size_t i, double before) {
    for (std::size_t j = 0; j < n; ++j)
      score.jacobian.push_back(j == i ? 1.0 : j + 1 == i ? before : 0.0);
  };
  for (std::size_t i = 0; i < n; ++i) {
    score.residuals.push_back(x[i] - 0.6);
    if (with_slopes) slope(i, 0.0);
    if (i == 0) continue;
    score.residuals.push_back(x[i] - x[i - 1] * x[i - 1] - 0.2);
    if (with_slopes) slope(i, -2.0 * x[i - 1]);
  }
  for (const double r : score.residuals) score.value += r * r;
  return score;
}

struct Turns {
  double seconds = 0.0;
  std::size_t count = 0;
  std::vector<double> last;
};

Turns in_cpp(Method method, int n) {
  const DesignSpace space = cube(n);
  std::vector<Result<Score>> outcomes;
  Turns turns;
  const auto search = make_optimizer(method, space, {});
  while (!search->converged() && outcomes.size() < kMostTurns) {
    const DesignPoint point = search->propose(1)[0];
    outcomes.push_back(valley(point.values, method == Method::levenberg_marquardt));
    search->observe(point, outcomes.back());
    turns.last = point.values;
  }
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const auto again = make_optimizer(method, space, {});
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& outcome : outcomes) again->observe(again->propose(1)[0], outcome);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    best = std::min(best, time.count());
  }
  turns.count = outcomes.size();
  turns.seconds = best / static_cast<double>(turns.count);
  return turns;
}

Turns in_python(Method method, int n) {
  std::istringstream text(output_of(
      fmt::format("{}/benchmarks/ask_tell_turns.py {} {}", LATSCH_SOURCE_DIR, name(method), n)));
  Turns turns;
  text >> turns.seconds >> turns.count;
  for (std::string value; text >> value;) turns.last.push_back(std::strtod(value.c_str(), nullptr));
  return turns;
}

void compare(benchmarks::Table& table, Method method, int n) {
  const Turns ours = in_cpp(method, n), theirs = in_python(method, n);
  const double more = theirs.seconds - ours.seconds;
  table.full_row(
      fmt::format(
          "{}, {} variables: a turn over C++'s {:.1f} us", name(method), n, 1e6 * ours.seconds),
      fmt::format("{:.1f} us", 1e6 * more),
      "<= 20 us",
      more <= kMostOverhead);
  table.row(fmt::format("its {} turns end at the same point, to the bit", ours.count),
            ours.last == theirs.last && ours.count == theirs.count ? "yes" : "no",
            "yes",
            ours.last == theirs.last && ours.count == theirs.count);
}

/// Returns the median time of `count` imports of the module, whose files the system has already
/// read into memory.
double import_seconds(int count) {
  std::vector<double> times;
  for (int k = 0; k < 1 + count; ++k)
    times.push_back(
        std::strtod(output_of("-c 'import time; begin = time.perf_counter(); import latsch; "
                              "print(time.perf_counter() - begin)'")
                        .c_str(),
                    nullptr));
  times.erase(times.begin());
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

int bench(const benchmarks::Options& options) {
  benchmarks::Table table("python", options);
  if (std::string(LATSCH_PYTHON).empty()) {
    table.skip("the Python package", "pybind11 or Python's headers are missing");
    return table.exit_code();
  }
  compare(table, Method::gss, 4);  // with more variables a turn takes too long for the comparison
  compare(table, Method::residual_trust_region, 4);
  compare(table, Method::levenberg_marquardt, 4);
  if (!options.is_smoke()) compare(table, Method::levenberg_marquardt, 12);
  const double import = import_seconds(options.size(5, 1));
  table.full_row(
      "import latsch", fmt::format("{:.3f} s", import), "<= 0.2 s", import <= kMostImport);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return benchmarks::run_benchmark(argc, argv, {}, bench); }
