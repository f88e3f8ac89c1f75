// SPDX-License-Identifier: Apache-2.0
// Broyden's fit minimizes the sum of squares S = r' r over some of the variables, starting at a
// nearby point at which the residuals and their derivatives are known. It needs only a few
// evaluations and is used for the steps of a profile or a cross-validation.
//
// The steps are those of Gauss and Newton: the free variables move by the d that minimizes |r + J
// d|^2 + lambda |d|^2  inside the unit cube, each by at most a quarter of its range. lambda is 0
// until a step fails [Levenberg, Q. Appl. Math. 2 (1944) 164]. Every residual vector corrects J by
// the smallest change that explains it,
//   J <- J + (r(u + d) - r(u) - J d) d' / d'd          [Broyden, Math. Comp. 19 (1965) 577]
// so no derivatives are evaluated until two steps in a row fail. Then J is recomputed by
// differences with the step lengths `differences`. The corrections improve J only along the path
// taken. The fit may therefore converge away from its start only after the columns of J for the
// variables in `refresh` have been recomputed once. The fit has converged if the predicted gain of
// a step is less than `tolerance` times S. It ends without convergence after `most_evaluations`, or
// if evaluations fail whatever the step. With linear constraints the step is the solution of a
// quadratic program; if a variable has room for a difference on neither side, its column of J is
// left to the corrections. If the evaluations return the model's own derivatives, J is that of the
// best point: nothing is corrected or recomputed, and the steps are Levenberg's.
//
// Ask and tell: evaluate wanted() and pass the outcome to observe(), until wanted() is empty.
#pragma once

#include <optional>
#include <vector>

#include "optimization/identifiability/confidence.h"
#include "optimization/problem/feasible_region.h"

namespace latsch {

struct BroydenFitOptions {
  double tolerance = 0.0;  // relative to S
  int most_evaluations = 20;
  std::vector<int> refresh = {};  // free variables whose columns of J are recomputed once
  /// Lengths of the differences, as shares of the ranges; empty: 0.001 for all.
  Eigen::VectorXd differences = {};
  /// Region of feasible points; nullopt: the unit cube.
  std::optional<FeasibleRegion> region = std::nullopt;
};

class BroydenFit {
 public:
  /// Begins a fit of the variables `free`, whose indices are in ascending order.
  BroydenFit(const Linearization& start, std::vector<int> free, const BroydenFitOptions& options);

  /// First moves variable `i`, which is not free, to `value`, and the free variables with it as J
  /// predicts. If no point inside the constraints has this value of the variable, the fit requests
  /// no evaluation.
  BroydenFit(const Linearization& start,
             std::vector<int> free,
             const BroydenFitOptions& options,
             int i,
             double value);

  /// First moves all variables that are not free to their values in `to`, and the free variables
  /// with them as J predicts. If no point inside the constraints has these values, the fit requests
  /// no evaluation.
  BroydenFit(const Linearization& start,
             std::vector<int> free,
             const BroydenFitOptions& options,
             const Eigen::VectorXd& to);

  /// Returns the next point of the unit cube to evaluate; nullopt when the fit is done.
  const std::optional<Eigen::VectorXd>& wanted() const { return wanted_; }
  /// Receives the outcome of the wanted point; nullopt if the evaluation failed.
  void observe(const std::optional<Evaluated>& evaluated);

  /// False if the evaluation of the first point with the moved variables failed, so that there is
  /// no fit at their values.
  bool fitted() const { return !moving_; }
  /// True if no step predicts an improvement; false while the fit requests a point or if it ended
  /// without convergence.
  bool converged() const { return converged_; }
  /// Returns the point with the least S so far, and the present approximation of J there.
  const Linearization& best() const { return best_; }
  int evaluations() const { return evaluations_; }

 private:
  void plan_step();
  void begin_differences(const std::vector<int>& columns);
  void plan_difference();
  double difference_of(int variable) const;
  bool is_constrained() const { return options_.region && !options_.region->is_cube(); }
  std::optional<Eigen::VectorXd> step_from(const Eigen::VectorXd& u,
                                           const Eigen::VectorXd& r,
                                           double lambda) const;
  bool promises(const Eigen::VectorXd& d) const;
  void step_observed(const std::optional<Evaluated>& evaluated);
  void difference_observed(const std::optional<Evaluated>& evaluated);

  Linearization best_;
  std::vector<int> free_;
  BroydenFitOptions options_;
  std::optional<Eigen::VectorXd> wanted_;
  /// True while the first point is being evaluated, which is accepted whatever its S.
  bool moving_ = false;
  double lambda_ = 0.0;
  bool converged_ = false, verified_ = false;
  int failed_steps_ = 0;      // number of failed steps in a row
  std::vector<int> columns_;  // columns of J being recomputed
  int difference_ = 0;        // index in columns_ of the derivative being evaluated
  int evaluations_ = 0;
};

}  // namespace latsch
