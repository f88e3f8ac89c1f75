// SPDX-License-Identifier: Apache-2.0
// Connects the design variables of a study with the parameters of its model.
//
// Any number in the model's file can be a variable. A prior of a variable counts as one more
// measured value, in the fit and in the intervals (optimization/problem/prior.h); it is weighted
// relative to the noise of the experiments, which must be stated. The keys are in
// correlation/study/keys/variable_keys.cpp.
#pragma once

#include <vector>

#include "base/document.h"
#include "experiment/language/specimen.h"
#include "optimization/problem/design_space.h"

namespace latsch::correlation {

/// Throws InputError if a path leads to no number of the model or if the paths have different
/// units. The variable is displayed in the unit of `initial`. DesignSpace checks the bounds.
DesignVariable read_variable(const Node& table, const Document& model);

/// Reads `vary`: parameters of the model with their usual bounds. A parameter outside of these
/// starts at the nearest bound. Throws InputError if a path leads to no number or to one without
/// usual bounds.
std::vector<DesignVariable> read_varied(const Node& root,
                                        const Document& model,
                                        const experiment::SpecimenKind& kind);

/// Reads `prior` and `prior_sigma` of a variable. Throws InputError if one is missing, if the
/// deviation is not positive, or if the prior of a logarithmic variable is not positive.
void read_prior(const Node& table, const std::string& unit, DesignVariable& variable);

/// Reads every [tie.NAME] and adds it to the variable that it follows. Throws InputError if a tie
/// follows nothing in the study, itself through other ties, or a number of another unit, and if its
/// own number is already changed by a variable.
void read_ties(const Node& root, const Document& model, std::vector<DesignVariable>& variables);

/// Returns the model with the values of the variables at a design point.
Document at(const Document& model, const DesignSpace& space, const DesignPoint& point);

}  // namespace latsch::correlation
