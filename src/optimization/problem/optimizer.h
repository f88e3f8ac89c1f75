// SPDX-License-Identifier: Apache-2.0
// An optimizer proposes points and observes their outcomes; it never evaluates.
//
// propose(count) lists the points to evaluate, most urgent first. The first point is the next step
// of the method. All later points are speculative: the method would propose them next if the
// outstanding outcomes came out as it expects. The caller evaluates as many points at once as it
// has workers, observes the *first* one, and calls propose again. Points that are no longer listed
// are withdrawn. So the path is the sequence of first points. It depends on the space, the options
// and the outcomes, never on the number of workers or their timing, and a single worker evaluates
// no point in vain.
//
//   while (!optimizer.converged()) {
//     const auto plan = optimizer.propose(look_ahead);
//     optimizer.observe(plan.front(), evaluate(plan.front()));
//   }
//
// Outcomes of points that the optimizer did not propose (from a design of experiments, or an
// earlier run) may be observed at any time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "optimization/problem/design_point.h"
#include "optimization/problem/ending_claim.h"
#include "optimization/problem/found_basin.h"
#include "optimization/problem/score.h"

namespace latsch {

class Optimizer {
 public:
  virtual ~Optimizer() = default;

  /// Returns at most `count` >= 1 different points, most urgent first; empty only when converged.
  virtual std::vector<DesignPoint> propose(int count) const = 0;

  /// Receives the outcome of a point. A Failure is an ordinary outcome: the point is worse than any
  /// that succeeded.
  virtual void observe(const DesignPoint& point, const Result<Score>& outcome) = 0;

  /// True if the search has ended: propose() then returns no points. A later outcome of another
  /// point may make the search continue.
  virtual bool converged() const = 0;

  /// Returns the reason why the search converged, in words that continue "the search ended: ". The
  /// text is empty before convergence and for methods that give no reason.
  virtual std::string ending() const { return {}; }

  /// Returns what ending() says, each statement with the test that it passed and the numbers of
  /// that test; empty before convergence.
  virtual std::vector<EndingClaim> claims() const { return claims_in(ending()); }

  /// Returns the share of its value by which the next step is expected to lower the target, for a
  /// search that is stopped before its end; nullopt if the method predicts nothing.
  virtual std::optional<double> promise() const { return std::nullopt; }

  /// Returns the minima found so far, lowest first; empty for methods that look for one alone.
  virtual std::vector<FoundBasin> basins() const { return {}; }
  /// Returns basins() in words; empty if there are none.
  virtual std::string basins_in_words() const { return {}; }
};

}  // namespace latsch
