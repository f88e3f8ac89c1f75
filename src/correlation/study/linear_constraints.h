// SPDX-License-Identifier: Apache-2.0
// Linear constraints on the variables of a study.
//
//   [linear_constraint.belt_softer]    # belt - 2 carcass <= 0
//   variables = ["belt", "carcass"]    # of one physical quantity, on a linear scale
//   coefficients = [1, -2]             # 1 each unless given
//   upper = "0 GPa"                    # and lower; or equal = "..." instead of both
//
// Every optimizer satisfies the linear constraints. A design of experiments samples the whole
// bounds and ignores them.
#pragma once

#include <vector>

#include "base/document.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

/// Reads one [linear_constraint.NAME]. DesignSpace refuses constraints that are senseless, alone or
/// with others.
LinearConstraint read_linear_constraint(const Node& table,
                                        const std::vector<DesignVariable>& variables);

/// Returns "belt - 2 carcass <= 0 GPa".
std::string in_words(const LinearConstraint& constraint, const DesignSpace& space);

}  // namespace latsch::correlation
