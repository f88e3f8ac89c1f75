// SPDX-License-Identifier: Apache-2.0
// The table [selection] of a study: which variables `latsch select` may drop from the fit.
//
// The keys are in correlation/study/keys/selection_keys.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/document.h"
#include "optimization/problem/design_space.h"
#include "optimization/selection/information_criterion.h"

namespace latsch::correlation {

/// Variables that are dropped or kept together.
struct SelectionUnit {
  std::string name;            // name of the variable, or of the group
  std::vector<int> variables;  // indices in the space, ascending
};

struct SelectionSettings {
  std::vector<SelectionUnit> units;  // candidates, in the order of the variables
  std::vector<double> toward;        // SI, one for each variable: its value if it is dropped
  SelectionCriterion criterion = SelectionCriterion::bic;
  int refits = 20;         // most refits of the path
  bool honest = false;     // true: one half of the recordings chooses, the other is refitted
  std::uint64_t seed = 0;  // selects the halves
};

/// Returns the settings of a study without [selection]: all variables are candidates.
SelectionSettings selection_of_all(const DesignSpace& space);

/// Reads [selection]. Throws InputError.
SelectionSettings read_coefficient_selection(const Node& table, const DesignSpace& space);

}  // namespace latsch::correlation
