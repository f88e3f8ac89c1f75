// SPDX-License-Identifier: Apache-2.0
// Solvers on the Moré-Wild problems. Data profiles are the share of the problems solved to tau
// within k (n + 1) evaluations, or simulation times. The true residuals decide whether a problem is
// solved, whatever noise or failures the solver sees.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "more_wild/more_wild_problems.h"
#include "optimization/direct_search/gss.h"
#include "optimization/problem/optimizer.h"
#include "table.h"

namespace latsch::benchmarks {

/// The disturbance a solver sees of the true residuals; a function of point and seed.
struct Disturbance {
  double noise = 0.0;     // standard deviation relative to every residual's own value
  double failures = 0.0;  // share of the points without outcome, except the start
  std::uint64_t seed = 1;
};

/// The time at which a problem was solved, in units of n + 1; infinite: not solved.
struct Solved {
  double at_1e3;  // tau = 1e-3
  double at_1e5;  // tau = 1e-5
};

/// The problem as a solver sees it, and the values the solver has reached.
class Observed {
 public:
  Observed(const more_wild::Problem& problem, const Disturbance& disturbance);

  /// Evaluates; the n-th call of this counts as n evaluations unless a time is given.
  Result<Score> operator()(const std::vector<double>& x);
  Result<Score> at_time(const std::vector<double>& x, double time);

  const more_wild::Problem& problem() const { return problem_; }
  int evaluations() const { return evaluations_; }
  const Solved& solved() const { return solved_; }
  bool is_done() const;

 private:
  const more_wild::Problem& problem_;
  Disturbance disturbance_;
  int evaluations_ = 0;
  double best_;
  Solved solved_;
};

/// Runs on the problem until `Observed` is done or has used most_evaluations.
using Solver = std::function<void(Observed&, int most_evaluations)>;

Solver residual_trust_region();
/// Returns GSS with the lengths of the problems, whatever the options are.
Solver gss(GssOptions options = {});
/// Returns a solver of NLopt by the number of nlopt_algorithm. A point that fails gets 1e300, which
/// makes methods that model values useless.
Solver nlopt(int algorithm);
/// Returns SciPy's least_squares with its own differences, in start steps from the start.
Solver scipy();

struct Profile {
  std::vector<double> budgets;  // k
  std::vector<double> tau_1e3;  // one share for each budget
  std::vector<double> tau_1e5;
};

Profile profile(const std::vector<Solved>& solved, const std::vector<double>& budgets);

/// Solves all problems, once for every disturbance, each within k (n + 1) evaluations. Several
/// threads are possible only for solvers in this process; the outcomes are the same.
std::vector<Solved> solve(const Solver& solver,
                          const std::vector<Disturbance>& disturbances,
                          double k,
                          const std::vector<more_wild::Problem>& problems,
                          int threads = 1);

/// Solves all problems serially, once for every disturbance, within the largest budget.
Profile measure(const Solver& solver,
                const std::vector<Disturbance>& disturbances,
                const std::vector<double>& budgets = {10, 50, 100},
                const std::vector<more_wild::Problem>& problems = more_wild::problems());

void note(Table& table, const std::string& solver, const Profile& profile);

/// Adds a row for tau and budget number k: a share, which only the full run judges.
void reach(Table& table, const std::string& what, double share, double at_least);

}  // namespace latsch::benchmarks
