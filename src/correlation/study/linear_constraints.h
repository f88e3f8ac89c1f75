// SPDX-License-Identifier: Apache-2.0
// Linear constraints on the variables of a study.
//
//   [linear_constraint.belt_softer]    # belt - 2 carcass <= 0
//   variables = ["belt", "carcass"]    # of one physical quantity, on a linear scale
//   coefficients = [1, -2]             # 1 each unless given
//   upper = "0 GPa"                    # and lower; or equal = "..." in the place of both
//
// Every method keeps to them. A design of experiments samples the bounds, whatever the
// constraints.
#pragma once

#include <vector>

#include "base/document.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

/// Reads one [linear_constraint.NAME]. What makes no sense of itself or with others is refused by
/// DesignSpace.
LinearConstraint read_linear_constraint(const Node& table,
                                        const std::vector<DesignVariable>& variables);

/// "belt - 2 carcass <= 0 GPa"
std::string in_words(const LinearConstraint& constraint, const DesignSpace& space);

}  // namespace latsch::correlation
