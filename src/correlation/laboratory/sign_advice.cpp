// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/sign_advice.h"

#include <algorithm>

#include "correlation/laboratory/columns_hint.h"
#include "measurement/meaning/channel_checks.h"

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

Channels with_other_sign(const Channels& channels, const std::string& name) {
  Channels turned;
  for (Channel channel : channels.all()) {
    if (channel.name == name)
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

}  // namespace

namespace {

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
    mirrored = with_other_sign(mirrored, last);
  }
  if (last.empty() || !signs_agree(mirrored)) return "";
  return columns_hint(stated, last, column_turned(record, last));
}

}  // namespace

std::string turned(const LabRecord& record, const std::string& channel) {
  return columns_hint(record.stated, channel, column_turned(record, channel));
}

std::vector<std::string> signs_that_agree(const LabRecord& record, bool axes_are_stated) {
  const Channels channels = thinned(record);
  std::vector<std::string> advice;
  if (signs_agree(channels)) return advice;
  if (!axes_are_stated)
    for (const AxisConvention axes : {AxisConvention::sae, AxisConvention::adapted_sae})
      if (signs_agree(to_iso(channels, axes)))
        advice.push_back("axes = \"" + axis_convention_names()[static_cast<std::size_t>(axes)] +
                         "\"");
  std::vector<std::string> names;
  for (const char* name : {"Fz", "Fy", "alpha", "Mz", "gamma", "kappa", "Fx"})
    if (const Channel* channel = record.find(name)) names.push_back(channel->name);
  for (const std::string& name : names)
    if (signs_agree(with_other_sign(channels, name))) advice.push_back(turned(record, name));
  for (const char* lateral : {"Fy", "alpha", "Mz"}) {
    const Channel* channel = record.find(lateral);
    if (!channel || !signs_agree(with_other_sign(channels, channel->name))) continue;
    const std::string mirrored = mirror_of(record, channels, channel->name);
    if (!mirrored.empty() && std::find(advice.begin(), advice.end(), mirrored) == advice.end())
      advice.push_back(mirrored);
  }
  if (!axes_are_stated)
    for (const std::string& name : names)
      if (const std::string also = words_beside_sae(name);
          !also.empty() &&
          signs_agree(to_iso(with_other_sign(channels, name), AxisConvention::sae)))
        advice.push_back("axes = \"sae\" and, because " + also + ", " + turned(record, name));
  if (!advice.empty()) return advice;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = i + 1; k < names.size(); ++k) {
      if (!signs_agree(with_other_sign(with_other_sign(channels, names[i]), names[k]))) continue;
      auto stated = record.stated;
      stated[names[i]] = column_turned(record, names[i]);
      advice.push_back(columns_hint(stated, names[k], column_turned(record, names[k])));
    }
  return advice;
}

}  // namespace latsch::correlation
