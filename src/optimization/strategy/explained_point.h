// SPDX-License-Identifier: Apache-2.0
// Decides without a trial whether a point lies in the basin of a known minimum.
//
// Quadratic models of all residuals around the minimum (residual_kriging.h), made from all known
// trials but this one, predict the residuals at the point. The minimum explains the point if the
// error is small beside the change of the residuals on the way, and the predicted sum of squares
// rises all the way from the minimum to the point.
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

/// True if the minimum explains the point. `known` may contain both. All places are in the unit
/// cube.
bool is_explained_by(const KnownResiduals& minimum,
                     const KnownResiduals& point,
                     const std::vector<KnownResiduals>& known);

}  // namespace latsch
