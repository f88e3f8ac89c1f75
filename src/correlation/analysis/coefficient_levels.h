// SPDX-License-Identifier: Apache-2.0
// Finds free coefficients of a Magic Formula that the fitted experiments cannot determine, because
// they hold too few levels of a test condition (experiment/rigs/slip/condition_levels.h).
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// Returns the values (SI) of a condition, "Fz" or "p", over all tests of the fitted experiments or
/// of all experiments. A test that does not state the condition adds none.
std::vector<double> driven_at(const Study& study, const std::string& condition, bool fitted_only);

struct UntoldCoefficient {
  std::string variable;
  /// Reason, such as "PPY4 is of order 2 in the pressure, of which there are 2 levels: ...".
  std::string reason;
  std::string stage = {};  // the stage that frees the coefficient; empty: no stages
};

/// Returns the coefficients in the order of the variables. Levels are counted over the experiments
/// of one stage, because these are fitted together. A coefficient is listed, once, if the last
/// stage that names its variable in `free` cannot determine it; if no stage names it, the last
/// stage that frees all variables decides. The list is empty if no variable is a coefficient of the
/// Magic Formula, or if no fitted test states the loads at which the tire rolls.
std::vector<UntoldCoefficient> untold_coefficients(const Study& study);

}  // namespace latsch::correlation
