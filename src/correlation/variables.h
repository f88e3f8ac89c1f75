// SPDX-License-Identifier: Apache-2.0
// Binds the design variables of a study to the numbers of its model.
//
//   [variable.matrix]
//   path = "rubber.matrix.young_modulus"     # or paths = ["...", "..."]: one value for several
//   numbers lower = "5 N/mm^2" upper = "50 N/mm^2" initial = "10 N/mm^2" scale = "logarithmic" # or
//   "linear"
//
// Any number in the model file can be varied; nothing in the model knows.
#pragma once

#include <vector>

#include "base/document.h"
#include "optimization/design_space.h"

namespace latsch::correlation {

/// Throws InputError where a path leads to no number of the model or paths disagree in their unit.
/// A person reads the variable in the unit `initial` is written in. Bounds are checked by
/// DesignSpace.
DesignVariable read_variable(const Node& table, const Document& model);

/// The model at a design point.
Document at(const Document& model, const DesignSpace& space, const DesignPoint& point);

}  // namespace latsch::correlation
