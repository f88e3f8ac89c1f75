// SPDX-License-Identifier: Apache-2.0
#include "optimization/problem/linear_constraint.h"

#include <cassert>

namespace latsch {

double LinearConstraint::sum(const std::vector<double>& values) const {
  assert(values.size() == coefficients.size());
  double total = 0.0;
  for (size_t i = 0; i < values.size(); ++i) total += coefficients[i] * values[i];
  return total;
}

}  // namespace latsch
