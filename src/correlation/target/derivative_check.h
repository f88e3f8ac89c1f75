// SPDX-License-Identifier: Apache-2.0
// Whether the slopes a model tells are those of the values it tells: beside central differences of
// the residuals, extrapolated from two lengths [Richardson, Phil. Trans. R. Soc. A 210 (1911) 307],
//
//   D = (4 D(h/2) - D(h)) / 3,    D(h) = (r(u + h) - r(u - h)) / 2h,    h = 1e-3 of the range
//
// A slope disagrees where it is off by more than 1e-5 of the largest of its variable and by more
// than ten times what the two lengths differ by, which is much where a kink lies between them. One
// closer to the point, as of a place of the tread that just touches, both lengths hide alike: there
// forward and backward differences do not come together with the length, and their
//
//   J = 2 j(h/2) - j(h),    j(h) = (r(u + h) - 2 r(u) + r(u - h)) / h
//
// counts as what the lengths differ by does. At a bound there are differences to one side alone;
// the point then moves inward by h.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "correlation/study/study.h"

namespace latsch::correlation {

/// Of one variable the residual whose slope disagrees most, or is furthest off.
struct CheckedSlope {
  std::string variable, row;             // "PKY1"; "side_force: steady/Fy, sample 3"
  double slope = 0.0, difference = 0.0;  // of that residual, over the range of the variable
  double off = 0.0;  // |slope - difference| over the largest |slope| of the variable
  bool agrees = true;
};

/// At the point, or where that lies at a bound beside it. A Failure where a trial fails; InputError
/// where the study has no slopes, saying why.
Result<std::vector<CheckedSlope>> check_slopes(const Study& study, const DesignPoint& point);

}  // namespace latsch::correlation
