// SPDX-License-Identifier: Apache-2.0
// Functions from a design point to the channels of all its experiments, and from channels to a
// score.
//
// The evaluator runs on the workers and takes long; the objective runs in the process that owns the
// journal and is fast. The journal stores channels, so that another objective can be computed from
// finished trials.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "base/result.h"
#include "measurement/channels.h"
#include "optimization/problem/design_point.h"
#include "optimization/problem/optimizer.h"

namespace latsch {

/// Returns the channels of a point. An evaluator is pure: the same point gives the same bits. If a
/// simulation does not succeed, the result is a Failure; an exception counts as a Failure, too,
/// with its text as the reason.
using Evaluator = std::function<Result<Channels>(const DesignPoint&)>;

/// Computes the score of a trial from its channels and, if there is prior knowledge of the
/// variables, from its point. A score that is not finite counts as a failure.
class Objective {
  template <class F>
  using IfOfChannels = std::enable_if_t<
      std::conjunction_v<std::negation<std::is_same<F, Objective>>,
                         std::is_invocable_r<Result<Score>, const F&, const Channels&>>>;

 public:
  /// Returns the score of a point and its channels, or the reason why they cannot be compared.
  using OfTrial = std::function<Result<Score>(const DesignPoint&, const Channels&)>;

  Objective() = default;
  /// If `needs_slopes` is true, a stored trial without slopes counts as not evaluated.
  Objective(OfTrial of_trial, bool needs_slopes = false)
      : of_trial_(std::move(of_trial)), needs_slopes_(needs_slopes) {}
  /// Creates an objective that does not depend on the point.
  template <class OfChannels, class = IfOfChannels<OfChannels>>
  Objective(OfChannels of_channels)
      : of_trial_([of_channels](const DesignPoint&, const Channels& channels) {
          return of_channels(channels);
        }) {}

  /// Returns false for an objective without a function.
  explicit operator bool() const { return static_cast<bool>(of_trial_); }
  /// Returns the score of a trial.
  Result<Score> operator()(const DesignPoint& point, const Channels& channels) const {
    return of_trial_(point, channels);
  }
  /// True if a trial stored without slopes counts as not evaluated.
  bool needs_slopes() const { return needs_slopes_; }
  /// Evaluates an objective that does not depend on the point.
  Result<Score> operator()(const Channels& channels) const { return of_trial_({}, channels); }

 private:
  OfTrial of_trial_;
  bool needs_slopes_ = false;
};

}  // namespace latsch
