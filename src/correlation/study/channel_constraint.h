// SPDX-License-Identifier: Apache-2.0
// A constraint on a value that a trial records; it is nonlinear in the variables.
//
// For the value y it is c = (lower - y) / scale, c = (y - upper) / scale, or h = (y - equal) /
// scale. The constraint counts as fulfilled up to 0.0001 of the scale
// (optimization/problem/score.h). The methods gss_nlc and sqp support such constraints. If the
// channel is not recorded, the error message lists the recorded ones. The keys are in
// correlation/study/keys/constraint_keys.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "correlation/observable/known_channels.h"
#include "measurement/channels.h"
#include "optimization/problem/score.h"

namespace latsch::correlation {

struct ChannelConstraint {
  std::string name;
  std::string channel;
  std::string of = "largest";
  bool is_of_stated = true;  // false: a lower bound on a channel of several values is refused
  std::optional<double> lower, upper;  // SI; lower == upper for an equation
  double scale = 1.0;
  std::string unit = "1";  // unit in which the value is shown to the user

  bool is_equation() const { return lower && upper && *lower == *upper; }
};

/// Reads one [constraint.NAME] on one of the `known` channels. Throws InputError if the trials have
/// no such channel or it has another quantity.
ChannelConstraint read_channel_constraint(const Node& table,
                                          const std::vector<KnownChannel>& known);

/// Reads bounds on one value of a channel, without a scale.
ChannelConstraint read_channel_range(const Node& table, const std::vector<KnownChannel>& known);

/// Returns the number that is constrained. Fails if the trial has no such channel, if the channel
/// is empty, or if it has several values and `of` is not stated beside a lower bound.
Result<double> value_of(const ChannelConstraint& constraint, const Channels& channels);

/// Adds the value c or h of the constraint to the score. Returns a Failure if the trial has no such
/// number.
Status apply(const ChannelConstraint& constraint, const Channels& channels, Score& score);

/// Returns "4 kN <= largest stiffness/force".
std::string in_words(const ChannelConstraint& constraint);

}  // namespace latsch::correlation
