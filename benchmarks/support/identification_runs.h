// SPDX-License-Identifier: Apache-2.0
// Runs solvers on the identification set. A data profile is the share of the runs that reach
//   f <= f_L + tau (f_0 - f_L)      within k (n + 1) evaluations,
// where f is the value without the disturbance, f_0 that at the start, and f_L the least value
// known. f_L is the best of two runs of sequential quadratic programming that know which corner of
// the design space fails, one from the true values and one from the start, or a lower value that a
// solver of this benchmark found.
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

/// Evaluates points for a solver, one after the other, and records the points and their values.
class Recorded {
 public:
  explicit Recorded(const identification_set::DisturbedProblem& problem) : problem_(problem) {}

  /// Returns the disturbed residuals that the solver sees at the point; nullopt if the evaluation
  /// fails there.
  std::optional<std::vector<double>> operator()(const std::vector<double>& x);
  /// Evaluates a point given in coordinates of the unit cube.
  std::optional<std::vector<double>> at_unit(const std::vector<double>& u);

  const identification_set::Problem& problem() const { return problem_.problem(); }
  int most() const { return kMostBudget * (problem().n() + 1); }
  bool is_spent() const { return static_cast<int>(exact_.size()) >= most(); }
  /// Returns the undisturbed values of all evaluated points.
  const std::vector<double>& exact() const { return exact_; }

 private:
  const identification_set::DisturbedProblem& problem_;
  std::vector<double> exact_;
};

using Solve = std::function<void(Recorded&)>;

/// Returns the method that `auto` chooses for a study with default options.
Solve shipped();
/// Runs the NLopt algorithm with this number, in the unit cube with a first step of 0.1. A failed
/// evaluation gets a value worse than all others. The algorithm runs in a separate process, which
/// is killed if it hangs.
std::vector<double> nlopt_values(int algorithm,
                                 const identification_set::DisturbedProblem& problem);

/// Runs SciPy's least_squares in the unit cube. `difference` is the relative step of its finite
/// differences; 0: the step that SciPy chooses.
void solve_by_scipy(SciPy& scipy, Recorded& recorded, double difference);

/// Returns the least undisturbed value among points that do not fail, found by a method that knows
/// where points fail.
double reference(const identification_set::DisturbedProblem& problem);

}  // namespace latsch::benchmarks
