// SPDX-License-Identifier: Apache-2.0
#include "identification_runs.h"

#include <fmt/format.h>
#include <nlopt.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>

#include "base/error.h"
#include "optimization/problem/feasible_region.h"
#include "optimization/sqp/sqp.h"
#include "optimization/strategy/optimizer_choice.h"

namespace latsch::benchmarks {
namespace {

using identification_set::DisturbedProblem;
using identification_set::HalfSpace;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// ms without output from a child process, after which it is killed
constexpr int kPatience = 10'000;

Score score(std::vector<double> residuals) {
  Score score{0.0, std::move(residuals)};
  for (const double r : score.residuals) score.value += r * r;
  return score;
}

DesignSpace unit_space(int n, std::vector<double> start, std::vector<LinearConstraint> rows) {
  std::vector<DesignVariable> variables;
  for (int i = 0; i < n; ++i) {
    variables.push_back({.name = std::to_string(i), .initial = std::clamp(start[i], 0.0, 1.0)});
  }
  return DesignSpace(variables, std::move(rows));
}

}  // namespace

std::optional<std::vector<double>> Recorded::operator()(const std::vector<double>& x) {
  exact_.push_back(problem_.exact(x));
  return problem_.shown(x);
}

std::optional<std::vector<double>> Recorded::at_unit(const std::vector<double>& u) {
  return (*this)(problem().space.from_unit(u).values);
}

Solve shipped() {
  return [](Recorded& recorded) {
    const DesignSpace& space = recorded.problem().space;
    const ProblemTraits traits{.variables = space.size(), .has_residuals = true};
    OptimizerSettings settings;
    settings.method = "auto";
    const auto method = make_optimizer(method_of(settings, traits).method, space, settings, traits);
    while (!method->converged() && !recorded.is_spent()) {
      const DesignPoint point = method->propose(1).front();
      const auto r = recorded(point.values);
      method->observe(point, r ? Result<Score>(score(*r)) : Failure{"in the corner"});
    }
  };
}

// NLopt ---------------------------------------------------------------------------------------

namespace {

struct Nlopt {
  Recorded recorded;
  double worst = 0.0;  // largest finite value so far
  int to_parent;
  nlopt_opt solver;
};

double value_for_nlopt(unsigned n, const double* u, double*, void* data) {
  auto& run = *static_cast<Nlopt*>(data);
  const auto r = run.recorded.at_unit({u, u + n});
  const double exact = run.recorded.exact().back();
  if (write(run.to_parent, &exact, sizeof exact) != sizeof exact) _exit(1);
  if (run.recorded.is_spent()) nlopt_force_stop(run.solver);
  if (!r) return 10.0 * run.worst;
  const double value = score(*r).value;
  run.worst = std::max(run.worst, value);
  return value;
}

[[noreturn]] void run_nlopt(int algorithm, const DisturbedProblem& problem, int to_parent) {
  const auto n = static_cast<unsigned>(problem.problem().n());
  const nlopt_opt solver = nlopt_create(static_cast<nlopt_algorithm>(algorithm), n);
  Nlopt run{Recorded(problem), 0.0, to_parent, solver};
  nlopt_set_min_objective(solver, value_for_nlopt, &run);
  nlopt_set_lower_bounds1(solver, 0.0);
  nlopt_set_upper_bounds1(solver, 1.0);
  nlopt_set_initial_step1(solver, 0.1);
  const DesignSpace& space = problem.problem().space;
  std::vector<double> u = space.to_unit(space.initial());
  double value = 0.0;
  nlopt_optimize(solver, u.data(), &value);
  _exit(0);
}

}  // namespace

std::vector<double> nlopt_values(int algorithm, const DisturbedProblem& problem) {
  int ends[2];
  if (pipe(ends) != 0) throw InputError("no pipe to a child can be had");
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_nlopt(algorithm, problem, ends[1]);
  }
  close(ends[1]);
  std::vector<double> exact;
  pollfd waiting{ends[0], POLLIN, 0};
  double value = 0.0;
  while (poll(&waiting, 1, kPatience) > 0 && read(ends[0], &value, sizeof value) == sizeof value) {
    exact.push_back(value);
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  close(ends[0]);
  return exact;
}

void solve_by_scipy(SciPy& scipy, Recorded& recorded, double difference) {
  const DesignSpace& space = recorded.problem().space;
  const auto ask = [&](const std::vector<double>& u) -> SciPy::Answer {
    if (recorded.is_spent()) return {.is_spent = true};
    return {recorded.at_unit(u)};
  };
  scipy.solve(space.to_unit(space.initial()), true, difference, ask);
}

// Least value known ---------------------------------------------------------------------------

namespace {

/// Returns the least value in the half space a'u <= b, from two starts: the true values and the
/// start of the problem.
double least_beside(const DisturbedProblem& problem, const HalfSpace* closed) {
  const DesignSpace& space = problem.problem().space;
  std::vector<LinearConstraint> rows;
  if (closed) {
    rows.push_back({.name = "open",
                    .coefficients = {closed->a.begin(), closed->a.end()},
                    .upper = closed->b - 1e-12});
  }
  double least = kInfinity;
  for (const bool from_truth : {true, false}) {
    const std::vector<double> wanted =
        from_truth ? space.to_unit({problem.problem().truth}) : space.to_unit(space.initial());
    const DesignSpace cube = unit_space(space.size(), std::vector<double>(wanted.size(), 0.5), {});
    const FeasibleRegion region(cube, rows);
    const Eigen::VectorXd inside =
        region.nearest(Eigen::Map<const Eigen::VectorXd>(wanted.data(), std::ssize(wanted)));
    const DesignSpace here = unit_space(space.size(), {inside.begin(), inside.end()}, rows);
    Sqp method(here, {.step_tolerance = 1e-8, .difference = 1e-8});
    for (int k = 0; k < 200 * (space.size() + 1) && !method.converged(); ++k) {
      const DesignPoint point = method.propose(1).front();
      const std::vector<double> x = space.from_unit(point.values).values;
      const Score now = score(problem.problem().residuals(x));
      if (!problem.fails(x) && now.value < least) least = now.value;
      const bool is_finite = std::isfinite(now.value);
      method.observe(point, is_finite ? Result<Score>(now) : Failure{"not finite"});
    }
  }
  return least;
}

}  // namespace

double reference(const DisturbedProblem& problem) {
  if (problem.corner().empty()) return least_beside(problem, nullptr);
  // A point outside of the failing corner lies outside of at least one of the half spaces that form
  // it, so each of them is closed in turn.
  double least = kInfinity;
  for (const HalfSpace& half : problem.corner()) {
    least = std::min(least, least_beside(problem, &half));
  }
  return least;
}

}  // namespace latsch::benchmarks
