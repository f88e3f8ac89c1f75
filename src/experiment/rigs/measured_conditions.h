// SPDX-License-Identifier: Apache-2.0
// What a test takes from a measurement of its study, in the place of numbers in its file:
//
//   deflections = {from = "measurement.pressed"}                # its channel deflection
//   speed = {from = "measurement.slow", channel = "drum_speed"} # or another one of it
//
//   states = {from = "measurement.run", without = ["kappa"]}    # left out though a column looks
//                                                               # like it
//
// It becomes numbers when the study is read, and a journal depends on these numbers alone: not on
// the file they stand in, nor on what was measured beside them.
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

/// A condition that a test takes from a measurement of its study.
struct MeasuredCondition {
  std::string channel, unit;   // SI
  bool is_needed = false;      // else left out where it was not recorded
  std::string frame = "";      // of a force
  std::string otherwise = "";  // what is taken where it was not recorded: "0"
};

/// Those that a table such as {from = "measurement.cornering"} names. InputError naming the place:
/// no such measurement, a condition it lacks. Empty: outside of a study.
using MeasuredConditions =
    std::function<Channels(const Node& table, const std::vector<MeasuredCondition>& conditions)>;

/// The table {from = ...} that stands under `key`; nullopt where something else or nothing does.
std::optional<Node> find_measured(const Node& test, std::string_view key);

/// Of such a table; InputError outside of a study.
Channels take_measured(const Node& table,
                       const std::vector<MeasuredCondition>& conditions,
                       const MeasuredConditions& measured);

/// All samples of a channel, each above 0.
std::vector<double> measured_values(const Node& table,
                                    const MeasuredCondition& condition,
                                    const MeasuredConditions& measured);
/// Their mean, above 0. InputError where they go far from it: a condition is held.
double measured_mean(const Node& table,
                     const MeasuredCondition& condition,
                     const MeasuredConditions& measured);
/// How many there are.
long measured_count(const Node& table,
                    const MeasuredCondition& condition,
                    const MeasuredConditions& measured);
/// m, from x, y, z; where there is a channel mode, as in a table of mode shapes, those of the
/// first.
Eigen::Matrix3Xd measured_points(const Node& table, const MeasuredConditions& measured);

}  // namespace latsch::experiment
