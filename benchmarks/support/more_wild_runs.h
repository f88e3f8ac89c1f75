// SPDX-License-Identifier: Apache-2.0
// Solvers on the Moré-Wild problems: data profiles, that is the share of the problems solved to tau
// within k (n + 1) evaluations, or simulation times.
//
// Whether a problem is solved is seen from its true residuals, whatever noise or failures the
// solver is shown.
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

/// What a solver is shown in place of the true residuals; a function of point and seed.
struct Disturbance {
  double noise = 0.0;     // standard deviation, of every residual's own value
  double failures = 0.0;  // share of the points without outcome, but the start
  std::uint64_t seed = 1;
};

/// When a problem was solved, in units of n + 1; infinite: it was not.
struct Solved {
  double at_1e3;  // tau = 1e-3
  double at_1e5;  // tau = 1e-5
};

/// The problem as a solver sees it, and what the solver has reached.
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
/// Lengths are those of the problems, whatever the options say.
Solver gss(GssOptions options = {});
/// nlopt_algorithm by its number. Where a point fails it is shown 1e300: one that makes models of
/// values is of no use there.
Solver nlopt(int algorithm);
/// SciPy's least_squares with its own differences, in start steps from the start.
Solver scipy();

struct Profile {
  std::vector<double> budgets;  // k
  std::vector<double> tau_1e3;  // shares, one a budget
  std::vector<double> tau_1e5;
};

Profile profile(const std::vector<Solved>& solved, const std::vector<double>& budgets);

/// All problems, once for every disturbance, each within k (n + 1) evaluations. On several threads
/// only for solvers in this process; the outcomes are the same.
std::vector<Solved> solve(const Solver& solver,
                          const std::vector<Disturbance>& disturbances,
                          double k,
                          const std::vector<more_wild::Problem>& problems,
                          int threads = 1);

/// All problems, serially, once for every disturbance, within the largest budget.
Profile measure(const Solver& solver,
                const std::vector<Disturbance>& disturbances,
                const std::vector<double>& budgets = {10, 50, 100},
                const std::vector<more_wild::Problem>& problems = more_wild::problems());

void note(Table& table, const std::string& solver, const Profile& profile);

/// A row for tau and budget number k: a share, which only the full run judges.
void reach(Table& table, const std::string& what, double share, double at_least);

}  // namespace latsch::benchmarks
