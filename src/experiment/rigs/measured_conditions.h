// SPDX-License-Identifier: Apache-2.0
// Conditions of a test that come from a measurement of its study instead of numbers in its file:
//
//   deflections = {from = "measurement.pressed"}                # its channel deflection
//   speed = {from = "measurement.slow", channel = "drum_speed"} # or another one of it
//
//   states = {from = "measurement.run", without = ["kappa"]}    # left out although a column looks
//                                                               # like it
//
// The conditions become numbers when the study is read, and a journal depends on these numbers
// alone, not on the file that contains them, nor on other channels of the measurement.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/document.h"
#include "measurement/channels.h"

namespace latsch::experiment {

/// A condition that a test reads from a measurement of its study.
struct MeasuredCondition {
  std::string channel, unit;   // SI
  bool is_needed = false;      // false: the condition is left out if it was not recorded
  std::string frame = "";      // for a force
  std::string otherwise = "";  // value assumed if the condition was not recorded: "0"
  std::string ignored = "";    // why the test computes without it; empty: the test uses it
  /// true for a force that acts at the origin of its frame; such a force differs between the frames
  /// W and H because their origins differ
  bool acts_at_origin = false;
};

/// Returns the channels that a table such as {from = "measurement.cornering"} names. Throws
/// InputError naming the place if the measurement does not exist or lacks a condition. A null
/// function: the test is outside of a study.
using MeasuredConditions =
    std::function<Channels(const Node& table, const std::vector<MeasuredCondition>& conditions)>;

/// Returns the table {from = ...} under `key`; nullopt if there is something else or nothing.
std::optional<Node> find_measured(const Node& test, std::string_view key);

/// Returns the channels of such a table; throws InputError outside of a study.
Channels take_measured(const Node& table,
                       const std::vector<MeasuredCondition>& conditions,
                       const MeasuredConditions& measured);

/// Returns all samples of a channel, each above 0.
std::vector<double> measured_values(const Node& table,
                                    const MeasuredCondition& condition,
                                    const MeasuredConditions& measured);
/// Returns the mean of the samples, above 0. Throws InputError if they deviate much from it,
/// because a condition is held constant.
double measured_mean(const Node& table,
                     const MeasuredCondition& condition,
                     const MeasuredConditions& measured);
/// Returns the number of samples.
long measured_count(const Node& table,
                    const MeasuredCondition& condition,
                    const MeasuredConditions& measured);
/// Returns points in m from x, y, z; if there is a channel `mode`, as in a table of mode shapes,
/// those of the first mode.
Eigen::Matrix3Xd measured_points(const Node& table, const MeasuredConditions& measured);

}  // namespace latsch::experiment
