// SPDX-License-Identifier: Apache-2.0
// Solvers on the Moré-Wild problems. A data profile is the share of the problems solved to the
// tolerance tau within k (n + 1) evaluations, or within that many mean trial times. The undisturbed
// residuals decide whether a problem is solved, whatever noise or failures the solver sees.
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

/// The disturbance between the true residuals and those that a solver sees. It is a function of the
/// point and the seed.
struct Disturbance {
  double noise = 0.0;     // standard deviation as a share of every residual
  double failures = 0.0;  // share of the points that have no outcome; the start always has one
  std::uint64_t seed = 1;
};

/// Time at which a problem was solved, in units of n + 1 evaluations; infinite if it was not
/// solved.
struct Solved {
  double at_1e3;  // tau = 1e-3
  double at_1e5;  // tau = 1e-5
};

/// The disturbed problem that a solver sees, and the undisturbed values that it has reached.
class Observed {
 public:
  Observed(const more_wild::Problem& problem, const Disturbance& disturbance);

  /// Evaluates a point. The n-th call counts as n evaluations; with at_time() the given time counts
  /// instead.
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

/// A solver, which runs on the problem until `Observed` reports that it is done, or for
/// most_evaluations.
using Solver = std::function<void(Observed&, int most_evaluations)>;

Solver residual_trust_region();
/// Returns GSS with the options, but with the step lengths that the problems prescribe.
Solver gss(GssOptions options = {});
/// Returns the NLopt solver with this number in the enumeration nlopt_algorithm. A point that
/// failed gets the value 1e300; methods that fit a model to the function then cannot be used.
Solver nlopt(int algorithm);
/// Returns SciPy's least_squares with its own finite differences, in variables that are measured
/// from the start in units of the first step.
Solver scipy();

struct Profile {
  std::vector<double> budgets;  // k
  /// share of problems solved to the tolerance 1e-3 for each budget; tau_1e5 likewise for 1e-5
  std::vector<double> tau_1e3;
  std::vector<double> tau_1e5;
};

Profile profile(const std::vector<Solved>& solved, const std::vector<double>& budgets);

/// Solves all problems, once for every disturbance, each within k (n + 1) evaluations. More than
/// one thread is allowed only for solvers that run in this process; the outcomes do not depend on
/// it.
std::vector<Solved> solve(const Solver& solver,
                          const std::vector<Disturbance>& disturbances,
                          double k,
                          const std::vector<more_wild::Problem>& problems,
                          int threads = 1);

/// Solves all problems one after the other, once for every disturbance, within the largest budget.
Profile measure(const Solver& solver,
                const std::vector<Disturbance>& disturbances,
                const std::vector<double>& budgets = {10, 50, 100},
                const std::vector<more_wild::Problem>& problems = more_wild::problems());

void note(Table& table, const std::string& solver, const Profile& profile);

/// Adds a row for the share of solved problems and its limit `at_least`; only the full run judges
/// it.
void reach(Table& table, const std::string& what, double share, double at_least);

}  // namespace latsch::benchmarks
