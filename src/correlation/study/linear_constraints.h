// SPDX-License-Identifier: Apache-2.0
// Linear constraints on the variables of a study.
//
// Every optimizer satisfies the linear constraints. A design of experiments samples the whole
// bounds and ignores them.
//
// The keys are in correlation/study/keys/linear_constraint_keys.cpp.
#pragma once

#include <vector>

#include "base/document.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

/// Reads one [linear_constraint.NAME]. DesignSpace later refuses constraints that contradict each
/// other or the bounds.
LinearConstraint read_linear_constraint(const Node& table,
                                        const std::vector<DesignVariable>& variables);

/// Returns the constraint as text, such as "belt - 2 carcass <= 0 GPa".
std::string in_words(const LinearConstraint& constraint, const DesignSpace& space);

}  // namespace latsch::correlation
