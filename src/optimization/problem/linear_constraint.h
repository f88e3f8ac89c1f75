// SPDX-License-Identifier: Apache-2.0
// A linear constraint on the design variables in the form a user states it, in SI:
//
//   lower <= sum_i a_i x_i <= upper
//
// If the bounds are equal, the constraint is an equation. Optimizers use the constraints of a space
// in its unit cube (feasible_region.h). A logarithmic variable would make the constraint a curved
// surface there, so constraints with such a variable are refused.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/error.h"

namespace latsch {

struct LinearConstraint {
  std::string name;                  // for people
  std::vector<double> coefficients;  // a_i, one for each variable in the order of the space
  /// Lower bound of the sum; infinite: no bound.
  double lower = -std::numeric_limits<double>::infinity();
  /// Upper bound of the sum; infinite: no bound.
  double upper = std::numeric_limits<double>::infinity();
  std::string unit = "1";  // display unit of the sum
  /// Place in the study that declares the constraint.
  Place place = {};

  /// True if the bounds are equal.
  bool is_equation() const { return lower == upper; }
  /// Returns the sum of a_i x_i, SI.
  double sum(const std::vector<double>& values) const;
};

}  // namespace latsch
