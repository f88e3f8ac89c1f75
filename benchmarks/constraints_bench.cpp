// SPDX-License-Identifier: Apache-2.0
// Constrained optimization on the problems of Hock and Schittkowski, with bounds, linear and
// nonlinear constraints. A problem counts as solved if all constraints are fulfilled
// (optimization/problem/score.h) and the objective is within 1e-4 of the published optimum, or
// within 1 % for the search that uses penalties. The difference is relative, or absolute for optima
// below 1. Nonsmooth penalties are included for comparison: they are known to end less accurately.
#include <fmt/format.h>

#include <algorithm>

#include "optimization/direct_search/gss.h"
#include "optimization/direct_search/gss_nlc.h"
#include "optimization/problem/hock_schittkowski_testing.h"
#include "optimization/sqp/sqp.h"
#include "optimization/trust_region/residual_trust_region.h"
#include "table.h"

namespace {

using namespace latsch;
using benchmarks::Options;
using benchmarks::Table;

constexpr int kMostEvaluations = 20000;

struct Found {
  Score score;
  int evaluations = 0;
};

Score score_at(const ConstrainedProblem& problem, const std::vector<double>& x) {
  return score_of(problem, x);
}
Score score_at(const LeastSquaresProblem& problem, const std::vector<double>& x) {
  return sum_of_squares(problem.residuals(x));
}

template <class Problem>
Found minimize(Optimizer& method, const Problem& problem) {
  Found found;
  while (!method.converged() && found.evaluations < kMostEvaluations) {
    const DesignPoint point = method.propose(1).front();
    const Score score = score_at(problem, point.values);
    if (++found.evaluations == 1 || is_better(score, found.score)) found.score = score;
    method.observe(point, score);
  }
  return found;
}

struct Outcome {
  int solved = 0;
  std::string evaluations;
};

template <class Problem, class Make>
Outcome solve_all(const std::vector<Problem>& problems, double within, Make&& make) {
  Outcome outcome;
  for (const Problem& problem : problems) {
    auto method = make(problem.space);
    const Found found = minimize(method, problem);
    const double off = std::abs(found.score.value - problem.least);
    outcome.solved += violation(found.score) <= kFulfilled &&
                      off <= within * std::max(1.0, std::abs(problem.least));
    outcome.evaluations += fmt::format(", {} {}", problem.name, found.evaluations);
  }
  return outcome;
}

template <class Problem, class Make>
void compare(Table& table,
             const std::string& name,
             const std::vector<Problem>& problems,
             double within,
             Make&& make) {
  const auto [solved, evaluations] = solve_all(problems, within, make);
  const auto all = std::ssize(problems);
  table.row(name,
            fmt::format("{} of {} solved", solved, all),
            fmt::format("{} of {}", all, all),
            solved == all);
  table.note(name + ", evaluations", evaluations.substr(2));
}

/// Returns all problems, or the first few in a smoke run.
template <class Problem>
std::vector<Problem> some(std::vector<Problem> all, const Options& options) {
  constexpr std::size_t kFew = 2;
  all.resize(options.size(all.size(), std::min(all.size(), kFew)), all.front());
  return all;
}

int bench(const Options& options) {
  Table table("constraints", options);
  const auto linear = some(linearly_constrained_problems(), options);
  const auto nonlinear = some(nonlinearly_constrained_problems(), options);
  const SqpOptions exact{.step_tolerance = 1e-5, .difference = 1e-7};
  const GssOptions fine{.step_tolerance = 1e-4};
  compare(table, "GSS, linear constraints", linear, 1e-4, [&](const DesignSpace& space) {
    return Gss(space, fine);
  });
  compare(table, "SQP, linear constraints", linear, 1e-4, [&](const DesignSpace& space) {
    return Sqp(space, exact);
  });
  const auto squares = some(constrained_least_squares_problems(), options);
  compare(table, "residual trust region, linear constraints", squares, 1e-4, [](const auto& space) {
    return ResidualTrustRegion(space);
  });
  const auto by_gss = solve_all(squares, 1e-4, [&](const auto& space) { return Gss(space, fine); });
  table.note("GSS on these", fmt::format("{} solved{}", by_gss.solved, by_gss.evaluations));
  const auto by_sqp =
      solve_all(squares, 1e-4, [&](const auto& space) { return Sqp(space, exact); });
  table.note("SQP on these", fmt::format("{} solved{}", by_sqp.solved, by_sqp.evaluations));
  compare(table, "SQP, nonlinear constraints", nonlinear, 1e-4, [&](const DesignSpace& space) {
    return Sqp(space, exact);
  });
  const auto penalized = [&](Penalty penalty) {
    return [&fine, penalty](const DesignSpace& space) {
      return GssNlc(space, {.gss = fine, .penalty = penalty});
    };
  };
  compare(table, "GSS-NLC", nonlinear, 1e-2, penalized(Penalty::l2_squared));
  for (const std::string& kind : penalty_names()) {
    if (kind == name(Penalty::l2_squared)) continue;
    const auto [solved, evaluations] = solve_all(nonlinear, 1e-2, penalized(penalty_of(kind)));
    table.note("GSS-NLC, " + kind, fmt::format("{} solved{}", solved, evaluations));
  }
  return table.exit_code();
}

}  // namespace

int main(int argc, char** argv) { return benchmarks::run_benchmark(argc, argv, {}, bench); }
