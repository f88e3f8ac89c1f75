// SPDX-License-Identifier: Apache-2.0
// Cost of a proposal of a search method as a function of the number of variables and of known
// points. Times depend on the machine. On any machine the cost of a proposal must not grow with the
// history as copying it would, and must stay acceptable for many variables.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "base/random.h"
#include "optimization/direct_search/gss.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "table.h"

namespace {

using namespace latsch;

DesignSpace cube(int n) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) variables.push_back({.name = std::to_string(i), .initial = 0.2});
  return DesignSpace(variables);
}

Score valley(const std::vector<double>& x) {
  Score score;
  for (std::size_t i = 0; i < x.size(); ++i) {
    score.residuals.push_back(x[i] - 0.6);
    if (i > 0) score.residuals.push_back(x[i] - x[i - 1] * x[i - 1] - 0.2);
  }
  for (const double r : score.residuals) score.value += r * r;
  return score;
}

double seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Runs the method until it has converged or done `most` steps; returns seconds per step.
double a_step(Optimizer& method, int look_ahead, int most, int& steps) {
  steps = 0;
  const double time = seconds([&] {
    for (; steps < most && !method.converged(); ++steps) {
      const DesignPoint point = method.propose(look_ahead).front();
      method.observe(point, valley(point.values));
    }
  });
  return time / std::max(1, steps);
}

/// Returns the seconds for proposing four points ahead if `known` points are already known.
double with_history(Optimizer& method, const DesignSpace& space, int known) {
  RandomStream random(7, 0);
  for (int k = 0; k < known; ++k) {
    DesignPoint point = space.initial();
    for (double& x : point.values) x = random.uniform();
    method.observe(point, valley(point.values));
  }
  constexpr int kCalls = 20;
  return seconds([&] {
           for (int k = 0; k < kCalls; ++k) method.propose(4);
         }) /
         kCalls;
}

/// A chain of twenty variables with 400 residuals, mildly curved. A corner of the cube fails.
Result<Score> curved_chain(const std::vector<double>& x) {
  constexpr int kResiduals = 400;
  const auto n = static_cast<int>(x.size());
  if (x[0] + x[1] > 1.1 || x[2] < 0.12) return Failure{"in the corner"};
  Score score;
  for (int i = 0; i < kResiduals; ++i) {
    const double t = (i + 0.5) / kResiduals;
    double value = 0.0;
    for (int k = 0; k < n; ++k) {
      const double away = x[k] - 0.4 - 0.01 * k;
      value += away * std::cos((k + 1) * 3.0 * t) + 0.3 * away * away * std::sin((k + 2) * t);
    }
    score.residuals.push_back(value + 0.05 * std::sin(40.0 * t));
  }
  for (const double r : score.residuals) score.value += r * r;
  return score;
}

/// Times of single proposals with 200 samples and 60 failures known, in ascending order.
std::vector<double> among_failures(int calls) {
  const DesignSpace space = cube(20);
  ResidualTrustRegion method(space);
  RandomStream random(11, 0);
  int samples = 0, failures = 0;
  while (samples < 200 || failures < 60) {
    DesignPoint point = space.initial();
    for (double& x : point.values) x = 0.1 + 0.8 * random.uniform();
    const auto outcome = curved_chain(point.values);
    int& count = outcome ? samples : failures;
    if (count >= (outcome ? 200 : 60)) continue;
    ++count;
    method.observe(point, outcome);
  }
  std::vector<double> times;
  for (int k = 0; k < calls && !method.converged(); ++k) {
    times.push_back(seconds([&] {
      const DesignPoint point = method.propose(1).front();
      method.observe(point, curved_chain(point.values));
    }));
  }
  std::sort(times.begin(), times.end());
  return times;
}

int bench(const benchmarks::Options& options) {
  benchmarks::Table table("proposal_cost", options);
  for (const int n : {20, 30, 40}) {
    Gss gss(cube(n));
    int steps = 0;
    const double step = a_step(gss, 1, options.size(3000, 100), steps);
    table.full_row(fmt::format("GSS, {} variables, a step", n),
                   fmt::format("{:.2f} ms, {} steps", 1e3 * step, steps),
                   "<= 10 ms",
                   step <= 10e-3);
  }
  const int kMany = options.size(20'000, 1'000), kFew = 200;
  const DesignSpace space = cube(6);
  for (const bool is_gss : {true, false}) {
    const auto make = [&]() -> std::unique_ptr<Optimizer> {
      if (is_gss) return std::make_unique<Gss>(space);
      return std::make_unique<ResidualTrustRegion>(space);
    };
    const double few = with_history(*make(), space, kFew);
    const double many = with_history(*make(), space, kMany);
    table.full_row(
        fmt::format("{}, four proposals, {} points known", is_gss ? "GSS" : "trust region", kMany),
        fmt::format("{:.2f} ms, {:.2f} with {}", 1e3 * many, 1e3 * few, kFew),
        "<= 10 ms",
        many <= 10e-3);
  }
  const std::vector<double> times = among_failures(options.size(60, 3));
  const double median = times[times.size() / 2], worst = times.back();
  table.full_row(
      "trust region, 20 variables, 400 residuals, 200 points, 60 failures: median, worst",
      fmt::format("{:.0f} ms, {:.0f} ms", 1e3 * median, 1e3 * worst),
      "<= 15 ms, 60 ms",
      median <= 15e-3 && worst <= 60e-3);
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, bench); }
