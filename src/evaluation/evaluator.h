// SPDX-License-Identifier: Apache-2.0
// From a design point to the channels of all its experiments, and from channels to a score.
//
// The evaluator runs where the workers are and is expensive; the objective runs in the process that
// owns the journal and is cheap. The journal keeps channels, so that another objective can be
// computed from finished trials.
#pragma once

#include <functional>

#include "base/result.h"
#include "measurement/channels.h"
#include "optimization/design_point.h"
#include "optimization/optimizer.h"

namespace latsch {

/// Pure: the same point gives the same bits. A simulation that does not succeed is a Failure; an
/// exception counts as one too, with its text as the reason.
using Evaluator = std::function<Result<Channels>(const DesignPoint&)>;

/// The target function. A score that is not finite counts as a failure.
using Objective = std::function<Result<Score>(const Channels&)>;

}  // namespace latsch
