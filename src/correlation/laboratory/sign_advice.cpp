// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/sign_advice.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "correlation/laboratory/columns_hint.h"
#include "measurement/meaning/channel_checks.h"
#include "measurement/meaning/channel_sense.h"
#include "measurement/meaning/suspension_checks.h"

namespace latsch::correlation {
namespace {

// samples; limits the time of a trial, because every trial statement is a pass over the samples
constexpr std::size_t kMostTried = 20'000;

/// Returns every n-th sample, so that at most kMostTried are left.
Channels thinned(const LabRecord& record) {
  const std::size_t every = record.samples() / kMostTried + 1;
  Channels channels;
  for (const Channel& channel : record.channels) {
    Channel few{channel.name, channel.unit, {}};
    for (std::size_t i = 0; i < channel.values.size(); i += every)
      few.values.push_back(channel.values[i]);
    channels.add(std::move(few));
  }
  return channels;
}

Channels with_other_sign(const Channels& channels, const std::vector<std::string>& names) {
  Channels turned;
  for (Channel channel : channels.all()) {
    if (std::find(names.begin(), names.end(), channel.name) != names.end())
      for (double& value : channel.values) value = -value;
    turned.add(std::move(channel));
  }
  return turned;
}

StatedColumn column_turned(const LabRecord& record, const std::string& channel) {
  StatedColumn column{channel, ""};
  if (const auto written = record.written.find(channel); written != record.written.end())
    column.column = written->second.column;
  const auto stated = record.stated.find(channel);
  if (stated != record.stated.end()) column = stated->second;
  column.sign = -column.sign;
  return column;
}

bool signs_agree(const Channels& channels) {
  const auto doubts = doubts_about(channels);
  return std::none_of(
      doubts.begin(), doubts.end(), [](const ChannelDoubt& doubt) { return doubt.is_of_sign; });
}

/// Returns the reason why a single column may have the opposite sign although the record is in sae
/// axes; empty for a column for which that is unusual.
std::string words_beside_sae(const std::string& channel) {
  if (channel.starts_with("Fz")) return "its loads are written as positive";
  return channel == "gamma" ? "its inclination has the other sign" : "";
}

/// Returns the table `columns` that changes the signs of all other lateral channels instead of that
/// of one: if the signs of a record agree, those of its mirror image agree as well. Returns an
/// empty text if they do not, or if there is no other lateral channel.
std::string mirror_of(const LabRecord& record, const Channels& channels, const std::string& name) {
  Channels mirrored = channels;
  auto stated = record.stated;
  std::string last;
  for (const char* lateral : {"Fy", "alpha", "Mz", "gamma"}) {
    const Channel* channel = record.find(lateral);
    if (!channel || channel->name == name) continue;
    if (!last.empty()) stated[last] = column_turned(record, last);
    last = channel->name;
    mirrored = with_other_sign(mirrored, {last});
  }
  if (last.empty() || !signs_agree(mirrored)) return "";
  return columns_hint(stated, last, column_turned(record, last));
}

/// Channels whose signs are changed together: one, or those of all wheels, as Fz_L and Fz_R.
using Group = std::vector<std::string>;

/// Returns the groups whose signs may be the wrong ones: the known channels, and every channel that
/// is doubted.
std::vector<Group> groups_of(const LabRecord& record, const Channels& channels) {
  std::vector<Group> groups;
  const auto add = [&](Group group) {
    if (!group.empty() && std::find(groups.begin(), groups.end(), group) == groups.end())
      groups.push_back(std::move(group));
  };
  for (const std::string base : {"Fz",
                                 "Fy",
                                 "alpha",
                                 "Mz",
                                 "gamma",
                                 "kappa",
                                 "Fx",
                                 "toe",
                                 "camber",
                                 "caster",
                                 "steer",
                                 "dx",
                                 "dy",
                                 "dz"}) {
    if (const Channel* channel = record.find(base)) {
      add({channel->name});
      continue;
    }
    Group wheels;
    for (const std::string& end : wheel_ends())
      if (channels.find(base + end)) wheels.push_back(base + end);
    add(std::move(wheels));
  }
  for (const ChannelDoubt& doubt : doubts_about(channels))
    if (doubt.is_of_sign) add({doubt.channel});
  return groups;
}

/// Returns the table `columns` that changes the signs of groups.
std::string groups_turned(const LabRecord& record, const std::vector<Group>& groups) {
  std::vector<std::string> names;
  for (const Group& group : groups) names.insert(names.end(), group.begin(), group.end());
  auto stated = record.stated;
  for (std::size_t i = 0; i + 1 < names.size(); ++i)
    stated[names[i]] = column_turned(record, names[i]);
  return columns_hint(stated, names.back(), column_turned(record, names.back()));
}

std::string statement_of(AxisConvention axes) {
  return "axes = \"" + axis_convention_names()[static_cast<std::size_t>(axes)] + "\"";
}

/// Returns words, to follow a statement that changes the sign of a group beside these axes, on how
/// side force and inclination of the file are directed if the statement is right: a record and its
/// mirror image differ in this alone. Returns an empty text if the record has no such pair, or if
/// the group is another than loads or inclination.
std::string when_right(const LabRecord& record, const Group& group, AxisConvention axes) {
  const Channel *Fy = record.find("Fy"), *gamma = record.find("gamma");
  const bool turns_lean = group.front() == "gamma";
  if (!Fy || !gamma || !(turns_lean || group.front().starts_with("Fz"))) return "";
  const auto written = [&](const Channel& channel) {
    const auto found = record.written.find(channel.name);
    return found == record.written.end() ? channel.name : found->second.column;
  };
  const auto sign = [&](const Channel& channel, ChannelSense sense) {
    const auto stated = record.stated.find(channel.name);
    return sign_to_iso(sense, axes) * (stated == record.stated.end() ? 1.0 : stated->second.sign);
  };
  const double side = sign(*Fy, ChannelSense::along_y);
  const double lean = sign(*gamma, ChannelSense::about_x) * (turns_lean ? -1.0 : 1.0);
  return fmt::format(
      " (right if at the rig a positive {} pushes the tire to the {} and a positive {} leans its "
      "top to the {}, seen from behind)",
      written(*Fy),
      side > 0.0 ? "left" : "right",
      written(*gamma),
      lean > 0.0 ? "right" : "left");
}

}  // namespace

std::vector<AxisConvention> axes_that_agree(const Channels& channels) {
  std::vector<AxisConvention> agreeing;
  for (const AxisConvention axes : {AxisConvention::iso,
                                    AxisConvention::sae,
                                    AxisConvention::adapted_sae,
                                    AxisConvention::adams})
    if (fault_of_axes(channels, axes).empty() && signs_agree(to_iso(channels, axes)))
      agreeing.push_back(axes);
  return agreeing;
}

std::string turned(const LabRecord& record, const std::string& channel) {
  return groups_turned(record, {{channel}});
}

std::vector<std::string> signs_that_agree(const LabRecord& record,
                                          std::optional<AxisConvention> stated) {
  const Channels channels = thinned(record);
  std::vector<std::string> advice;
  if (signs_agree(channels)) return advice;
  const AxisConvention taken = stated.value_or(AxisConvention::iso);
  // A convention changes signs alone, so that turning twice gives the channels as the file has
  // them.
  const Channels as_written = to_iso(channels, taken);
  const std::string in_place =
      stated ? " in place of " + in_quotes(axis_convention_names()[static_cast<std::size_t>(taken)])
             : "";
  const bool can_be_turned = record.turned_from.empty();
  if (can_be_turned)
    for (const AxisConvention axes : axes_that_agree(as_written))
      if (axes != taken) advice.push_back(statement_of(axes) + in_place);
  const std::vector<Group> groups = groups_of(record, channels);
  for (const Group& group : groups)
    if (signs_agree(with_other_sign(channels, group)))
      advice.push_back(groups_turned(record, {group}) + when_right(record, group, taken));
  for (const char* lateral : {"Fy", "alpha", "Mz"}) {
    const Channel* channel = record.find(lateral);
    if (!channel || !signs_agree(with_other_sign(channels, {channel->name}))) continue;
    const std::string mirrored = mirror_of(record, channels, channel->name);
    if (!mirrored.empty() && std::find(advice.begin(), advice.end(), mirrored) == advice.end())
      advice.push_back(mirrored);
  }
  if (can_be_turned && taken != AxisConvention::sae)
    for (const Group& group : groups)
      if (const std::string also = words_beside_sae(group.front());
          !also.empty() &&
          signs_agree(to_iso(with_other_sign(as_written, group), AxisConvention::sae)))
        advice.push_back(statement_of(AxisConvention::sae) + in_place + " and, because " + also +
                         ", " + groups_turned(record, {group}) +
                         when_right(record, group, AxisConvention::sae));
  if (!advice.empty()) return advice;
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t k = i + 1; k < groups.size(); ++k)
      if (signs_agree(with_other_sign(with_other_sign(channels, groups[i]), groups[k])))
        advice.push_back(groups_turned(record, {groups[i], groups[k]}));
  return advice;
}

}  // namespace latsch::correlation
