// SPDX-License-Identifier: Apache-2.0
// Solvers on the identification set: data profiles, that is the share of the runs that reach
//   f <= f_L + tau (f_0 - f_L)      within k (n + 1) evaluations,
// f without the disturbance, f_L the least value known: what sequential quadratic programming finds
// from truth and start with the failing corner told to it, or a solver of the bench below that.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification_set/disturbed_problem.h"
#include "scipy_peer.h"

namespace latsch::benchmarks {

inline constexpr int kMostBudget = 50;  // of n + 1
inline constexpr int kBudgets[] = {5, 10, 20, 50};

/// What a solver asked for, one after the other.
class Recorded {
 public:
  explicit Recorded(const identification_set::DisturbedProblem& problem) : problem_(problem) {}

  /// What the solver is shown; nullopt: a failure.
  std::optional<std::vector<double>> operator()(const std::vector<double>& x);
  /// The same of a point in the unit cube.
  std::optional<std::vector<double>> at_unit(const std::vector<double>& u);

  const identification_set::Problem& problem() const { return problem_.problem(); }
  int most() const { return kMostBudget * (problem().n() + 1); }
  bool is_spent() const { return static_cast<int>(exact_.size()) >= most(); }
  /// Undisturbed values.
  const std::vector<double>& exact() const { return exact_; }

 private:
  const identification_set::DisturbedProblem& problem_;
  std::vector<double> exact_;
};

using Solve = std::function<void(Recorded&)>;

/// The method `auto` gives a study, with the options a study has where it states none.
Solve shipped();
/// NLopt's algorithm by its number, in the unit cube with a first step of 0.1, a failure being
/// worse than anything; in a process of its own, which is killed where it hangs.
std::vector<double> nlopt_values(int algorithm,
                                 const identification_set::DisturbedProblem& problem);

/// SciPy's least_squares in the unit cube; differences of this relative step, 0: its own.
void solve_by_scipy(SciPy& scipy, Recorded& recorded, double difference);

/// The least undisturbed value of points that do not fail, by a method that is told where they do.
double reference(const identification_set::DisturbedProblem& problem);

}  // namespace latsch::benchmarks
