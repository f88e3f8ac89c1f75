// SPDX-License-Identifier: Apache-2.0
// What an optimizer is told in the place of a failure, where the policy asks for that. The trial
// itself stays a failure in the journal, in the trajectory and in the report.
//
// recover       a declared value, the worse the farther from anything that succeeds: for methods
//               that cannot take a failure. Residuals are all the same and have it as their sum of
//               squares; nonlinear constraints count as violated by 1.
// continuation  the failed point t is approached from the nearest point s of the trajectory that
//               succeeded, in the unit cube of the design space:
//                 m = (s + t) / 2;  s = m where m succeeds, else t = m;  so often as is asked for
//               Every m is a trial like others, observed for what it is, and the last s answers for
//               the failed point. Where no m succeeds the failure stands.
//
// Both are named after Dakota's failure capturing. There a simulation may start from the state the
// step before left behind, so that the failed point itself may succeed in the end; here a trial
// knows of no other, and its point fails again. What continuation gives is the value at the edge of
// where the model works.
//
// Of the trajectory alone, so that it is the same for any number of workers and after a crash.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "evaluation/schedule/run_options.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// A point the optimizer observed.
struct Step {
  DesignPoint point;
  Result<Score> outcome;
  std::optional<Score> answer = {};  // what it was told in the place of a failure
};

/// The outcome of the first of these points, most wanted first; nullptr where it cannot be had.
using Ask = std::function<const Result<Score>*(std::span<const DesignPoint> wanted)>;

/// The penalty as a score with as many residuals and constraints as the scores before had; nothing
/// before one succeeded: how many there are is not known then.
std::optional<Score> recovered(const FailurePolicy& policy, const std::vector<Step>& before);

/// The trials of a continuation, in their order, and the answer they give.
struct Continuation {
  std::vector<Step> steps;
  std::optional<Score> answer;
};

/// `behind`: what is wanted after the trials of the continuation, where there are idle workers for
/// speculation. nullopt where a trial cannot be had.
std::optional<Continuation> continued(const FailurePolicy& policy,
                                      const std::vector<Step>& before,
                                      const DesignPoint& failed,
                                      std::optional<std::span<const DesignPoint>> behind,
                                      const Ask& ask);

}  // namespace latsch
