// SPDX-License-Identifier: Apache-2.0
// Values that are reported to the optimizer in place of a failure, if the failure policy says so.
// The trial itself stays a failure in the journal, in the trajectory and in the report.
//
// recover       A declared penalty, equal for all failed points, for methods that cannot handle a
//               failure. All residuals are equal, and their sum of squares is the penalty;
//               nonlinear constraints count as violated by 1.
// continuation  The failed point t is approached from the nearest successful point s of the
//               trajectory, in the unit cube of the design space:
//                 m = (s + t) / 2;  s = m if m succeeds, else t = m;  repeated `halvings` times
//               Every m is a normal trial that the optimizer observes, and the last s gives the
//               value for the failed point. If no m succeeds, the failure remains.
//
// Both are named after Dakota's failure capturing. In Dakota a simulation may start from the final
// state of the preceding one, so that the failed point itself may succeed in the end. Here trials
// are independent, and the point would fail again. Continuation therefore uses the value at the
// edge of the region where the model works.
//
// The values depend on the trajectory alone, so they are equal for any number of workers and after
// a crash.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "evaluation/schedule/run_options.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// A point that the optimizer observed, with its outcome.
struct Step {
  DesignPoint point;
  Result<Score> outcome;
  std::optional<Score> answer = {};  // value reported to the optimizer in place of a failure
};

/// Returns the outcome of the first of these points; the others are evaluated meanwhile, the most
/// urgent first. Returns nullptr if the outcome cannot be obtained.
using Ask = std::function<const Result<Score>*(std::span<const DesignPoint> wanted)>;

/// Returns the penalty as a score with as many residuals and constraints as earlier scores have.
/// Returns nullopt before the first success, because the numbers of residuals and constraints are
/// not known then.
std::optional<Score> recovered(const FailurePolicy& policy, const std::vector<Step>& before);

/// The trials of a continuation, in their order, and the resulting value.
struct Continuation {
  std::vector<Step> steps;
  std::optional<Score> answer;
};

/// Runs a continuation. `behind` are points wanted after its trials, for speculation if workers are
/// idle. Returns nullopt if the outcome of a trial cannot be obtained.
std::optional<Continuation> continued(const FailurePolicy& policy,
                                      const std::vector<Step>& before,
                                      const DesignPoint& failed,
                                      std::optional<std::span<const DesignPoint>> behind,
                                      const Ask& ask);

}  // namespace latsch
