// SPDX-License-Identifier: Apache-2.0
// Decides without a trial whether a point lies in the basin of a known minimum.
//
// Quadratic models of all residuals around the minimum (residual_kriging.h), made from the known
// trials nearest to the minimum or to the point, but not from these two, predict the residuals at
// the point. The minimum explains the point if the error is small compared with the change of the
// residuals from the minimum to the point, and the predicted sum of squares rises all the way. A
// point within a hundredth of the ranges is the minimum itself.
//
// Limit: a basin between both, of which no trial shows a trace, is not seen.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace latsch {

/// Residuals of a trial, and its place in the unit cube.
struct KnownResiduals {
  Eigen::VectorXd u, r;
};

/// True if the minimum explains the point with an error of at most `largest_error`, as a share of
/// the change of the residuals. `known` may contain both. All places are in the unit cube.
bool is_explained_by(const KnownResiduals& minimum,
                     const KnownResiduals& point,
                     const std::vector<KnownResiduals>& known,
                     double largest_error);

}  // namespace latsch
