// SPDX-License-Identifier: Apache-2.0
// An optimizer proposes points and observes what came of them; it never evaluates.
//
// propose(count) names the points it would like to know, most wanted first. The first is the next
// step of the method; those behind it are speculation: what the method would ask next if the
// outcomes it waits for came out as it expects. The caller evaluates as many of them at once as it
// has workers and observes the *first* one, then asks again. Points that are no longer named are
// withdrawn. So the trajectory is the sequence of firsts: a function of the space, the options and
// the outcomes, never of the number of workers or of their timing; and one worker wastes nothing.
//
//   while (!optimizer.converged()) {
//     const auto plan = optimizer.propose(look_ahead);
//     optimizer.observe(plan.front(), evaluate(plan.front()));
//   }
//
// Outcomes of points the optimizer did not ask for (a DOE, an earlier run) may be observed at any
// time.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "optimization/problem/design_point.h"
#include "optimization/problem/score.h"

namespace latsch {

class Optimizer {
 public:
  virtual ~Optimizer() = default;

  /// At most `count` >= 1 different points, most wanted first; empty only when converged.
  virtual std::vector<DesignPoint> propose(int count) const = 0;

  /// The outcome of a point. A Failure is an ordinary outcome: the point is worse than any that
  /// succeeded.
  virtual void observe(const DesignPoint& point, const Result<Score>& outcome) = 0;

  virtual bool converged() const = 0;

  /// Why it converged, in words that go on after "the search ended: "; empty before, and where a
  /// method does not say.
  virtual std::string ending() const { return {}; }
};

}  // namespace latsch
