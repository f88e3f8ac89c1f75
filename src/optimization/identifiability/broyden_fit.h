// SPDX-License-Identifier: Apache-2.0
// Broyden's fit: the least sum of squares S = r' r of some of the variables, from a point nearby
// where the residuals and their derivatives are known. A few evaluations, no more: what a profile
// or a cross-validation needs at each of its steps.
//
// The steps are those of Gauss and Newton: the free variables move by the d with the least
// |r + J d|^2 + lambda |d|^2  inside the unit cube, each by at most a quarter of its range; lambda
// is 0 until a step fails [Levenberg, Q. Appl. Math. 2 (1944) 164]. Every residual vector corrects
// J by the least change that explains it,
//   J <- J + (r(u + d) - r(u) - J d) d' / d'd          [Broyden, Math. Comp. 19 (1965) 577]
// so no derivatives are evaluated, until two steps in a row fail: then J is taken anew by
// differences, each as long as `differences` says. Corrections know J only along the way that was
// gone; `refresh` names the variables whose columns are taken anew once before it may converge
// elsewhere. It has converged where a step promises less than `tolerance` of S; at
// `most_evaluations`, or where evaluations fail whatever the step, it ends without. Among linear
// constraints the step is a quadratic program, and a difference for which neither side has room
// leaves its column of J to the corrections. Where the evaluations bring the model's own slopes, J
// is those of the best point: nothing is corrected or taken anew, and the steps are Levenberg's.
//
// Ask and tell: evaluate wanted(), observe() what they tell, until wanted() is empty.
#pragma once

#include <optional>
#include <vector>

#include "optimization/identifiability/confidence.h"
#include "optimization/problem/feasible_region.h"

namespace latsch {

struct BroydenFitOptions {
  double tolerance = 0.0;  // of S
  int most_evaluations = 20;
  std::vector<int> refresh = {};     // of the free variables
  Eigen::VectorXd differences = {};  // of the range, a length a variable; none: 0.001 each
  std::optional<FeasibleRegion> region = std::nullopt;  // none: the unit cube
};

class BroydenFit {
 public:
  /// `free`: the variables that may move, in ascending order.
  BroydenFit(const Linearization& start, std::vector<int> free, const BroydenFitOptions& options);

  /// The same, but variable `i`, not among the free ones, is moved to `value` first, the free ones
  /// following it as J says. It wants nothing where no point inside the constraints has that value.
  BroydenFit(const Linearization& start,
             std::vector<int> free,
             const BroydenFitOptions& options,
             int i,
             double value);

  /// The next point of the unit cube; nullopt when it is done.
  const std::optional<Eigen::VectorXd>& wanted() const { return wanted_; }
  /// nullopt where the evaluation failed.
  void observe(const std::optional<Evaluated>& evaluated);

  /// False where a moved variable's point failed: there is no fit at its value.
  bool fitted() const { return !moving_; }
  /// Nothing more was promised. False while it wants something, and where it had to give up.
  bool converged() const { return converged_; }
  /// The least S so far, with J as far as it is known there.
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
  bool moving_ = false;  // the first point is under way; it counts whatever its S
  double lambda_ = 0.0;
  bool converged_ = false, verified_ = false;
  int failed_steps_ = 0;      // in a row
  std::vector<int> columns_;  // of J that are taken anew; empty: none
  int difference_ = 0;        // place in columns_ of the derivative under way
  int evaluations_ = 0;
};

}  // namespace latsch
