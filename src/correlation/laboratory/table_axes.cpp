// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/table_axes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "base/text.h"
#include "correlation/laboratory/sign_advice.h"
#include "measurement/axes.h"
#include "measurement/meaning/channel_checks.h"
#include "measurement/meaning/suspension_checks.h"

namespace latsch::correlation {
namespace {

std::string name_of(AxisConvention axes) {
  return in_quotes(axis_convention_names()[static_cast<std::size_t>(axes)]);
}

/// Returns the channels of a measurement that something in the study uses.
std::set<std::string> used_channels(const Measurement& measurement) {
  std::set<std::string> used;
  for (const Ledger& ledger : measurement.ledgers())
    for (const LedgerRow& row : ledger.rows)
      if (!row.used_by.empty() && !row.written.empty())
        used.insert(row.taken_as.empty() ? row.written : row.taken_as);
  return used;
}

/// True for a motion of a wheel on a K&C rig, or its slope over a load.
bool is_motion(std::string_view channel) {
  constexpr std::array<std::string_view, 8> kMotions = {
      "toe", "camber", "caster", "steer", "dx", "dy", "dz", "rack"};
  return std::any_of(kMotions.begin(), kMotions.end(), [&](std::string_view motion) {
    return channel == motion || channel.starts_with(std::string(motion) + "_");
  });
}

/// True if the convention changes a number in a channel that is used.
bool changes(const Channels& channels, AxisConvention axes, const std::set<std::string>& used) {
  const Channels turned = to_iso(channels, axes);
  return std::any_of(used.begin(), used.end(), [&](const std::string& name) {
    const Channel *before = channels.find(name), *after = turned.find(name);
    if (!before || !after) return false;
    for (std::size_t i = 0; i < before->values.size(); ++i)
      if (before->values[i] + after->values[i] == 0.0 && before->values[i] != 0.0) return true;
    return false;
  });
}

}  // namespace

std::vector<std::string> statements_for_side(const Measurement& measurement,
                                             bool axes_are_stated,
                                             int side) {
  std::vector<std::string> statements;
  const Channels& channels = measurement.channels();
  for (const AxisConvention axes : axes_that_agree(channels))
    if (!axes_are_stated && side_of_wheel(to_iso(channels, axes)) == side)
      statements.push_back("axes = " + name_of(axes));
  Channels turned;
  std::string columns;
  for (Channel channel : measurement.channels().all()) {
    if (channel.name.starts_with("toe") || channel.name.starts_with("camber")) {
      for (double& value : channel.values) value = -value;
      columns += fmt::format("{}{} = \"-{}\"",
                             columns.empty() ? "" : ", ",
                             channel.name,
                             measurement.written(channel.name).column);
    }
    turned.add(std::move(channel));
  }
  if (side_of_wheel(turned) == side)
    statements.push_back(
        fmt::format("columns = {{{}}}, if only the signs of toe and camber are exchanged (front "
                    "inboard and top outboard are positive)",
                    columns));
  return statements;
}

std::vector<std::string> axes_alike(const Measurement& measurement, int side) {
  const Channels& channels = measurement.channels();
  const std::set<std::string> used = used_channels(measurement);
  std::vector<std::string> others;
  if (wheel_rolls(channels) || std::none_of(used.begin(), used.end(), is_motion)) return others;
  bool fits_iso = false;
  for (const AxisConvention axes : axes_that_agree(channels)) {
    const int shown = side_of_wheel(to_iso(channels, axes));
    if (side != 0 && shown != 0 && shown != side) continue;
    fits_iso = fits_iso || axes == AxisConvention::iso;
    if (changes(channels, axes, used)) others.push_back(name_of(axes));
  }
  if (!fits_iso || others.empty()) return {};
  others.insert(others.begin(), name_of(AxisConvention::iso));
  return others;
}

}  // namespace latsch::correlation
