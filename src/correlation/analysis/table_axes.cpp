// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/table_axes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <memory>
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

using experiment::Finding;
using experiment::written_at;

std::string name_of(AxisConvention axes) {
  return in_quotes(axis_convention_names()[static_cast<std::size_t>(axes)]);
}

/// Returns "left" or "right" if the model states the side of its wheel, otherwise "".
std::string side_of_model(const Study& study) {
  const Node root = study.model.root();
  const std::string side = root.has("side") ? root.text("side") : "";
  return side == "left" || side == "right" ? side : "";
}

bool axes_are_stated(const Measurement& measurement, const Document& file) {
  return measurement.is_stated() &&
         file.root().table("measurement").table(measurement.name()).has("axes");
}

/// Returns the statements after which a K&C table has the signs of the given side, +1 for left:
/// axes, if none are stated, and the table `columns` with toe and camber turned.
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

/// Compares the side of the car to which a K&C table belongs, as the signs of toe and camber show
/// it, with the side that the model states.
void examine_sides(const Study& study, const Document& file, std::vector<Finding>& found) {
  const std::string side = side_of_model(study);
  if (side.empty()) return;
  for (const auto& measurement : study.laboratory) {
    const int measured = side_of_wheel(measurement->channels());
    if (measured == 0 || (measured > 0) == (side == "left")) continue;
    const std::string table = "measurement." + measurement->name();
    const auto statements = statements_for_side(
        *measurement, axes_are_stated(*measurement, file), side == "left" ? 1 : -1);
    found.push_back(
        {written_at(file, table + ".file").place,
         fmt::format(
             "{} has the signs of a {} wheel (toe over Mz, camber over Fy), but the model "
             "is a {} one{}{}",
             table,
             measured > 0 ? "left" : "right",
             side,
             statements.empty() ? "" : fmt::format(". If the wheel is the {} one, say ", side),
             fmt::join(statements, "; or ")),
         false});
  }
}

/// Returns every measurement that the study uses: those of [measurement.NAME], and files that an
/// experiment names itself.
Laboratory measurements_of(const Study& study) {
  Laboratory all = study.laboratory;
  for (const StudyExperiment& experiment : study.experiments)
    if (experiment.read_from && std::none_of(all.begin(), all.end(), [&](const auto& one) {
          return one == experiment.read_from ||
                 (!one->is_stated() && one->files() == experiment.read_from->files());
        }))
      all.push_back(experiment.read_from);
  return all;
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

/// Returns the other conventions in which the signs of a table in iso agree and that would change
/// what the study uses; empty if the signs contradict iso, which is told where the table is read.
std::vector<std::string> other_axes(const Measurement& measurement, const std::string& side) {
  const Channels& channels = measurement.channels();
  const std::set<std::string> used = used_channels(measurement);
  std::vector<std::string> others;
  if (wheel_rolls(channels) || std::none_of(used.begin(), used.end(), is_motion)) return others;
  bool fits_iso = false;
  for (const AxisConvention axes : axes_that_agree(channels)) {
    const int shown = side_of_wheel(to_iso(channels, axes));
    if (!side.empty() && shown != 0 && (shown > 0) != (side == "left")) continue;
    fits_iso = fits_iso || axes == AxisConvention::iso;
    if (changes(channels, axes, used)) others.push_back(name_of(axes));
  }
  return fits_iso ? others : std::vector<std::string>();
}

void examine_unstated_axes(const Study& study, const Document& file, std::vector<Finding>& found) {
  const std::string side = side_of_model(study);
  for (const auto& measurement : measurements_of(study)) {
    if (axes_are_stated(*measurement, file)) continue;
    std::vector<std::string> others = other_axes(*measurement, side);
    if (others.empty()) continue;
    const std::string last = others.back();
    others.pop_back();
    others.insert(others.begin(), name_of(AxisConvention::iso));
    const std::string all = fmt::format("{} or {}", fmt::join(others, ", "), last);
    const bool is_stated = measurement->is_stated();
    found.push_back(
        {is_stated ? written_at(file, "measurement." + measurement->name() + ".file").place
                   : measurement->place(),
         fmt::format("{}{} states no axes, so iso is taken (x forward, y to the left, z up), and "
                     "its signs do not tell the axes: with {} in {} they agree alike, and the "
                     "results differ. Say axes = {}",
                     is_stated ? "measurement." : "",
                     measurement->name(),
                     measurement->samples() == 1
                         ? std::string("its one row")
                         : fmt::format("its {} rows", measurement->samples()),
                     all,
                     all + (is_stated ? "" : " in a [measurement.NAME] of the file")),
         false});
  }
}

}  // namespace

std::vector<Finding> doubts_about_table_axes(const Study& study, const Document& file) {
  std::vector<Finding> found;
  examine_sides(study, file, found);
  examine_unstated_axes(study, file, found);
  return found;
}

}  // namespace latsch::correlation
