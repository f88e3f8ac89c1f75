// SPDX-License-Identifier: Apache-2.0
// Cross-validation measures how well a model predicts measurements it was not fitted to.
//
// The residuals fall into groups, for example load cases. Each group is left out in turn, the
// variables are refitted (broyden_fit.h) to the rest, and the group's residuals are computed at the
// refitted point. If they are much larger than in the common fit, either the group holds
// information that no other group has, or the model cannot fit both. A refit that does not
// converge, because its evaluations fail or run out, predicts nothing. [Stone, J. R. Statist. Soc.
// B 36 (1974) 111]
//
// Ask and tell in rounds, as in Identification: each round contains one point of every unfinished
// group.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "base/result.h"
#include "optimization/identifiability/broyden_fit.h"

namespace latsch {

/// Result for one group of residuals.
struct LeftOut {
  int group = 0;        // the group that the refit did not use
  Eigen::VectorXd u;    // the point refitted without the group
  double fitted = 0.0;  // root mean square of the group's residuals in the common fit
  /// Root mean square of the group's residuals after the refit; NaN if it did not converge.
  double predicted = 0.0;
};

class CrossValidation {
 public:
  /// `group` holds the group of every residual of the common fit `best`, or a negative number if
  /// the residual is never left out; at least two groups are required. `tolerance` is that of
  /// BroydenFitOptions. `free` lists the variables that may move, in ascending order; empty: all.
  /// `values` holds the number of residuals of each group, if the rows of `best` and of the
  /// observed outcomes are reduced (reduced_rows.h); empty: one per row.
  CrossValidation(const DesignSpace& space,
                  const Linearization& best,
                  const std::vector<int>& group,
                  double tolerance,
                  std::vector<int> free = {},
                  const std::map<int, Eigen::Index>& values = {});

  /// Returns the points to be evaluated next; empty when done.
  const std::vector<DesignPoint>& wanted() const { return wanted_; }
  /// Receives the outcomes of the wanted points, in their order.
  void observe(const std::vector<Result<Evaluated>>& evaluated);

  /// Returns the share of the evaluations that is done, estimated from the usual number of
  /// evaluations of a fold.
  double share_done() const;
  /// Returns one entry for each group, in ascending order, when done.
  const std::vector<LeftOut>& left_out() const { return left_out_; }

 private:
  struct Fold {
    std::vector<Eigen::Index> rest, out;  // rows
    double values;                        // number of residuals of the group
    BroydenFit refit;
    LeftOut result;
  };
  void ask();

  DesignSpace space_;
  std::vector<Fold> folds_;
  std::vector<int> asked_;
  std::vector<DesignPoint> wanted_;
  std::vector<LeftOut> left_out_;
};

}  // namespace latsch
