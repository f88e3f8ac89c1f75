// SPDX-License-Identifier: Apache-2.0
// A check of the directions that residuals hardly feel, by moves along these directions themselves.
//
// J is made of differences, one variable at a time. Where variables are tied, as the factors of a
// product, their columns are parallel, and what is left of J v along the direction v of the tie is
// the error of the differences: curvature, rounding of a simulation's output. Under noise that is
// nothing; in a fit without noise an interval made of it would be short and wrong. So a direction
// that counts as held, and which
//   - is felt by less than twice what curvature makes of the differences, or
//   - in a fit that leaves next to nothing, is felt by less than a hundredth of the strongest one,
// is moved along, by lengths l of 0.002 and 0.0002 of the range:
//   g(l) = (r(u + l v) - r(u - l v)) / 2l
// Of J v, g(l1), g(l2) two of different lengths have to agree to a quarter of the smaller one; J
// then has that slope along v. Where none do, nothing is known along v, and J v = 0.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimization/identifiability/confidence.h"

namespace latsch {

/// How J was made, for every column of it.
struct Differences {
  Eigen::VectorXd lengths;    // of the range
  Eigen::VectorXd curvature;  // the error that it may make of the column, its norm
};

class WeakDirections {
 public:
  /// `c`: of `at`.
  WeakDirections(const DesignSpace& space,
                 const Linearization& at,
                 const Confidence& c,
                 const Differences& made,
                 const ConfidenceOptions& options);

  /// In the unit cube; empty: nothing is to be checked.
  const std::vector<Eigen::VectorXd>& wanted() const { return wanted_; }
  /// Residuals at wanted(); nullopt: failed. Returns J with the slopes that hold.
  Eigen::MatrixXd checked(const Linearization& at,
                          const std::vector<std::optional<Eigen::VectorXd>>& residuals);
  /// How that J was made.
  const Differences& made() const { return made_; }
  /// Those along which nothing is known. After checked().
  const std::vector<Eigen::VectorXd>& unknown() const { return unknown_; }

 private:
  struct Stencil {
    int direction;  // in directions_
    double length;
    double near, far;  // offsets along the direction: two sides, or twice the one
  };

  std::optional<Eigen::VectorXd> slope(const Stencil& stencil,
                                       const Eigen::VectorXd& center,
                                       const Eigen::VectorXd* near,
                                       const Eigen::VectorXd* far) const;

  struct Direction {
    Eigen::VectorXd v;
    double length;  // of the differences that J v is made of
  };

  Differences made_;
  std::vector<Direction> directions_;
  std::vector<Stencil> stencils_;  // two points of wanted_ each
  std::vector<Eigen::VectorXd> wanted_, unknown_;
};

}  // namespace latsch
