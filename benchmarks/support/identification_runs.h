// SPDX-License-Identifier: Apache-2.0
// Solvers on the identification set. Data profiles are the share of the runs that reach
//   f <= f_L + tau (f_0 - f_L)      within k (n + 1) evaluations,
// where f is the value without the disturbance and f_L the least value known. It is the best of two
// runs of sequential quadratic programming that know which corner fails, one from the true values
// and one from the start, or a lower value that a solver of this benchmark found.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification_set/disturbed_problem.h"
#include "scipy_peer.h"

namespace latsch::benchmarks {

inline constexpr int kMostBudget = 50;  // multiple of n + 1
inline constexpr int kBudgets[] = {5, 10, 20, 50};

/// Records the points a solver evaluates, one after the other.
class Recorded {
 public:
  explicit Recorded(const identification_set::DisturbedProblem& problem) : problem_(problem) {}

  /// Returns what the solver gets; nullopt: a failure.
  std::optional<std::vector<double>> operator()(const std::vector<double>& x);
  /// Evaluates a point of the unit cube.
  std::optional<std::vector<double>> at_unit(const std::vector<double>& u);

  const identification_set::Problem& problem() const { return problem_.problem(); }
  int most() const { return kMostBudget * (problem().n() + 1); }
  bool is_spent() const { return static_cast<int>(exact_.size()) >= most(); }
  /// Returns the undisturbed values.
  const std::vector<double>& exact() const { return exact_; }

 private:
  const identification_set::DisturbedProblem& problem_;
  std::vector<double> exact_;
};

using Solve = std::function<void(Recorded&)>;

/// Returns the method that `auto` gives a study, with the default options of a study.
Solve shipped();
/// Runs NLopt's algorithm by its number, in the unit cube with a first step of 0.1. A failure
/// counts as worse than any value. It runs in a separate process, which is killed if it hangs.
std::vector<double> nlopt_values(int algorithm,
                                 const identification_set::DisturbedProblem& problem);

/// Runs SciPy's least_squares in the unit cube with differences of this relative step; 0: its own.
void solve_by_scipy(SciPy& scipy, Recorded& recorded, double difference);

/// Returns the least undisturbed value of points that do not fail, by a method that knows where
/// points fail.
double reference(const identification_set::DisturbedProblem& problem);

}  // namespace latsch::benchmarks
