// SPDX-License-Identifier: Apache-2.0
// Checks the slopes that a model reports against central differences of the residuals, extrapolated
// from two lengths [Richardson, Phil. Trans. R. Soc. A 210 (1911) 307],
//
//   D = (4 D(h/2) - D(h)) / 3,    D(h) = (r(u + h) - r(u - h)) / 2h,    h = 1e-3 of the range
//
// A slope disagrees if its error exceeds 1e-5 of the largest slope of its variable and ten times
// the difference between the two lengths, which is large if a kink lies between them. A kink closer
// to the point, as where a point of the tread just touches, affects both lengths alike. Then
// forward and backward differences do not approach each other as the length falls, and their
// difference
//
//   J = 2 j(h/2) - j(h),    j(h) = (r(u + h) - 2 r(u) + r(u - h)) / h
//
// is used in addition to the difference between the lengths. At a bound there are differences to
// one side only; the point then moves inward by h.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Result of the check of one variable: the residual whose derivative disagrees, or the one with
/// the largest error.
struct CheckedSlope {
  /// name of the variable, "PKY1", and name of the residual, "side_force: steady/Fy, sample 3"
  std::string variable, row;
  double slope = 0.0, difference = 0.0;  // slopes of that residual over the variable's range
  double off = 0.0;  // |slope - difference| over the largest |slope| of the variable
  bool agrees = true;
};

/// Checks at the point or, if it lies at a bound, beside it. Fails if a trial fails. Throws
/// InputError with the reason if the study has no slopes.
Result<std::vector<CheckedSlope>> check_slopes(const Study& study, const DesignPoint& point);

}  // namespace latsch::correlation
