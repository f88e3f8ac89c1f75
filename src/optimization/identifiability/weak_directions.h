// SPDX-License-Identifier: Apache-2.0
// Checks directions with little effect on the residuals by moves along these directions themselves.
//
// J is made of differences, one variable at a time. If variables are coupled, as the factors of a
// product are, their columns of J are parallel. Along the direction v of the coupling, J v then
// contains only the error of the differences: curvature, and rounding of a simulation's output. If
// the data are noisy, this error is negligible; in a fit without noise, an interval based on it
// would be too short and wrong. So a direction is checked if it counts as determined by the data
// and
//   - its effect J v is less than twice the error of the differences by curvature, or
//   - in a fit with almost no residuals, J v is less than a hundredth of that of the strongest one.
// The check moves along the direction by lengths l of 0.002 and 0.0002 of the range:
//   g(l) = (r(u + l v) - r(u - l v)) / 2l
// Two of J v, g(l1), g(l2) with different lengths have to agree to a quarter of the smaller one; J
// then gets that slope along v. If no two agree, nothing is known along v, and J v is set to 0.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/identifiability/confidence.h"

namespace latsch {

/// Lengths and errors of the differences from which the columns of J were computed.
struct Differences {
  Eigen::VectorXd lengths;    // length of each column's difference, as a share of the range
  Eigen::VectorXd curvature;  // norm of the error that curvature may cause in the column
};

class WeakDirections {
 public:
  /// Chooses the directions to check. `c` is the confidence at the linearization `at`.
  WeakDirections(const DesignSpace& space,
                 const Linearization& at,
                 const Confidence& c,
                 const Differences& made,
                 const ConfidenceOptions& options);

  /// Returns points of the unit cube; empty if nothing is to be checked.
  const std::vector<Eigen::VectorXd>& wanted() const { return wanted_; }
  /// Receives the residuals at wanted(); nullopt if an evaluation failed. Returns J with the
  /// confirmed slopes.
  Eigen::MatrixXd checked(const Linearization& at,
                          const std::vector<std::optional<Eigen::VectorXd>>& residuals);
  /// Returns lengths and errors of the differences for the checked J.
  const Differences& made() const { return made_; }
  /// Returns the directions along which nothing is known. Valid after checked().
  const std::vector<Eigen::VectorXd>& unknown() const { return unknown_; }

 private:
  struct Stencil {
    int direction;  // index of the direction in directions_
    double length;
    /// Offsets of the two points along the direction: on both sides of the center, or on one side,
    /// one twice as far as the other.
    double near, far;
  };

  std::optional<Eigen::VectorXd> slope(const Stencil& stencil,
                                       const Eigen::VectorXd& center,
                                       const Eigen::VectorXd* near,
                                       const Eigen::VectorXd* far) const;

  struct Direction {
    Eigen::VectorXd v;
    double length;  // length of the differences from which J v was computed
  };

  Differences made_;
  std::vector<Direction> directions_;
  std::vector<Stencil> stencils_;  // each stencil belongs to two points of wanted_
  std::vector<Eigen::VectorXd> wanted_, unknown_;
};

}  // namespace latsch
