// SPDX-License-Identifier: Apache-2.0
// Presents an analysis that asks for trials in rounds as an optimizer, so that the scheduler runs
// them.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "optimization/identifiability/confidence.h"
#include "optimization/problem/design_space.h"
#include "optimization/problem/optimizer.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {

/// Presents an analysis to the scheduler as an optimizer whose points of one round are proposed
/// together, in their order.
template <class Analysis>
class InRounds : public Optimizer {
 public:
  /// The optimizer ends if the analysis needs no more points, or if `ends` returns true after a
  /// round. `reduced` says that scores are those of RefitTrials.
  InRounds(
      const DesignSpace& space,
      Analysis& analysis,
      bool reduced = false,
      std::function<bool()> ends = [] { return false; })
      : space_(space), analysis_(analysis), reduced_(reduced), ends_(std::move(ends)) {}

  std::vector<DesignPoint> propose(int count) const override {
    const auto& wanted = analysis_.wanted();
    const auto first = wanted.begin() + std::ssize(seen_);
    return {first, first + std::min<std::ptrdiff_t>(count, wanted.end() - first)};
  }

  void observe(const DesignPoint& point, const Result<Score>& outcome) override {
    seen_.push_back(evaluated(point, outcome));
    if (seen_.size() < analysis_.wanted().size() && !is_enough()) return;
    const auto round = std::move(seen_);
    seen_ = {};
    analysis_.observe(round);
  }

  bool converged() const override {
    return analysis_.wanted().empty() || (seen_.empty() && ends_());
  }

 private:
  bool is_enough() const {
    if constexpr (requires { analysis_.is_enough(seen_.front()); })
      return analysis_.is_enough(seen_.front());
    return false;
  }

  Result<Evaluated> evaluated(const DesignPoint& point, const Result<Score>& outcome) const {
    if (!outcome) return outcome.failure();
    Evaluated one(to_vector(outcome->residuals), space_.unit_jacobian(point, *outcome));
    if (reduced_ && !one.has_slopes()) return Failure{"a derivative is not finite"};
    one.is_reduced = reduced_;
    return one;
  }

  const DesignSpace& space_;
  Analysis& analysis_;
  bool reduced_;
  std::function<bool()> ends_;
  std::vector<Result<Evaluated>> seen_;  // outcomes of this round
};

}  // namespace latsch::correlation
