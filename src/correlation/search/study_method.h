// SPDX-License-Identifier: Apache-2.0
// Chooses the optimizer of a study from what the study knows of its own target: residuals,
// constraints, noise.
#pragma once

#include <memory>

#include "correlation/study/study.h"
#include "optimization/strategy/optimizer_choice.h"

namespace latsch::correlation {

/// Returns the method. It does not depend on the content of the journal, so a resumed run uses the
/// same one.
MethodChoice method_of(const Study& study);

std::unique_ptr<Optimizer> make_optimizer(const Study& study);

}  // namespace latsch::correlation
