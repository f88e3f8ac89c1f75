// SPDX-License-Identifier: Apache-2.0
// Cost of a proposal of a search method as a function of the number of variables and of known
// points. Times depend on the machine. On any machine the cost of a proposal must not grow with the
// history as copying it would, and must stay acceptable for many variables.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>

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
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return latsch::benchmarks::run_benchmark(argc, argv, {}, bench); }
