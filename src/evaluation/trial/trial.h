// SPDX-License-Identifier: Apache-2.0
// One point under evaluation and its outcome.
#pragma once

#include "base/result.h"
#include "evaluation/trial/evaluator.h"
#include "measurement/channels.h"
#include "optimization/problem/design_point.h"

namespace latsch {

/// Channels, or the reason why there are none, and their cost.
struct Outcome {
  Result<Channels> result;    // the channels, or the reason why there are none
  double wall_time = 0.0;     // s
  double cpu_time = 0.0;      // CPU time of the evaluating thread, s
  int worker = 0;             // number of the worker that evaluated the point
  double program_time = 0.0;  // s, user and system CPU time of completed outside programs
};

/// One evaluation: the point and its outcome.
struct Trial {
  DesignPoint point;  // in SI, in the order of the design space
  Outcome outcome;    // channels and cost
};

/// Runs the evaluator on the point and measures the time. Exceptions and numbers that are not
/// finite become failures.
Outcome evaluate(const Evaluator& evaluator, const DesignPoint& point);

/// Returns the channels, or a Failure that names the first number in them that is not finite.
Result<Channels> finite(Channels channels);

}  // namespace latsch
