// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/recorder_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "base/unit_reading.h"
#include "formats/tables/lab_columns.h"
#include "measurement/meaning/channel_words.h"

namespace latsch::formats {
namespace {

constexpr double kMostJoinedNumbers = 134217728.0;  // 1 GiB of numbers

std::vector<std::string> names_of_groups(const RecordedFile& file) {
  std::vector<std::string> names;
  for (const RecordedGroup& group : file.groups) names.push_back(group.name);
  return names;
}

/// Returns the groups that have a known channel beside their abscissa.
std::vector<std::size_t> known_groups(const RecordedFile& file) {
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < file.groups.size(); ++i) {
    const RecordedGroup& group = file.groups[i];
    const auto begin = group.channels.begin() + (group.has_abscissa ? 1 : 0);
    if (std::any_of(begin, group.channels.end(), [](const RecordedChannel& channel) {
          return recognized(channel.name).has_value();
        }))
      known.push_back(i);
  }
  return known;
}

RecordedGroup chosen_group(RecordedFile& file, const std::string& part, LabTable& table) {
  const std::vector<std::string> names = names_of_groups(file);
  if (!part.empty()) {
    const auto found = std::find(names.begin(), names.end(), part);
    if (found == names.end())
      throw InputError({file.file, 0},
                       "has no group " + in_quotes(part) + did_you_mean(part, names) +
                           " (groups: " + list_of(names) + ")");
    return std::move(file.groups[static_cast<std::size_t>(found - names.begin())]);
  }
  if (file.groups.size() == 1) return std::move(file.groups.front());
  const std::vector<std::size_t> known = known_groups(file);
  if (known.size() == 1) {
    table.assumed_struct = names[known.front()];
  } else {
    table.structs = names;
  }
  return std::move(file.groups[known.empty() ? 0 : known.front()]);
}

/// A group's time in s and its channels, for joining.
struct TimedGroup {
  std::vector<double> time;
  RecordedGroup* group = nullptr;
};

double mean_step(const TimedGroup& group) {
  return (group.time.back() - group.time.front()) / static_cast<double>(group.time.size() - 1);
}

/// Returns the time of a group in s. Throws InputError if it falls back or has gaps.
std::vector<double> time_of(const RecordedGroup& group, const std::string& file) {
  const RecordedChannel& channel = group.channels.front();
  const auto unit = find_unit(channel.unit, Unit::of("s"));
  std::vector<double> time = channel.values;
  for (std::size_t i = 0; i < time.size(); ++i) {
    time[i] = unit->to_si(time[i]);
    if (std::isnan(time[i]) || (i > 0 && !(time[i] > time[i - 1])))
      throw InputError({file, 0},
                       fmt::format("cannot be resampled: {} of group {} {} at sample {}",
                                   in_quotes(channel.name),
                                   in_quotes(group.name),
                                   std::isnan(time[i]) ? "is not a number" : "does not rise",
                                   i + 1));
  }
  return time;
}

bool has_time(const RecordedGroup& group) {
  if (!group.has_abscissa || group.samples() < 2) return false;
  const auto unit = find_unit(group.channels.front().unit, Unit::of("s"));
  return unit && unit->same_dimension(Unit::of("s"));
}

/// Returns the values at the times of a grid, linear between samples.
std::vector<double> at_times(const std::vector<double>& time,
                             const std::vector<double>& values,
                             const std::vector<double>& grid) {
  std::vector<double> result;
  result.reserve(grid.size());
  std::size_t i = 0;
  for (const double t : grid) {
    while (i + 2 < time.size() && time[i + 1] <= t) ++i;
    const double share = (t - time[i]) / (time[i + 1] - time[i]);
    result.push_back(share <= 0.0   ? values[i]
                     : share >= 1.0 ? values[i + 1]
                                    : values[i] + share * (values[i + 1] - values[i]));
  }
  return result;
}

/// Returns one group with the channels of all groups at multiples of the step from the latest
/// beginning to the earliest end.
RecordedGroup joined_groups(RecordedFile& file, double step, LabTable& table) {
  std::vector<TimedGroup> timed;
  double first = -INFINITY, last = INFINITY, channels = 1.0;
  for (RecordedGroup& group : file.groups) {
    if (!has_time(group)) {
      table.doubts.push_back(
          {"", "group " + in_quotes(group.name) + " has no time and is not resampled", {}});
      table.doubts.back().place = {file.file, 0};
      continue;
    }
    timed.push_back({time_of(group, file.file), &group});
    first = std::max(first, timed.back().time.front());
    last = std::min(last, timed.back().time.back());
    channels += static_cast<double>(group.channels.size());
  }
  if (timed.empty()) throw InputError({file.file, 0}, "has no group with a time to resample");
  if (!(last >= first))
    throw InputError({file.file, 0},
                     fmt::format("cannot be resampled: a group begins at {:g} s, when another one "
                                 "has ended at {:g} s; name one by group = {}",
                                 first,
                                 last,
                                 in_quotes(timed.front().group->name)));
  const TimedGroup& fastest =
      *std::min_element(timed.begin(), timed.end(), [](const auto& a, const auto& b) {
        return mean_step(a) < mean_step(b);
      });
  const double steps = std::floor((last - first) / step * (1.0 + 1e-12));
  if (!((steps + 1.0) * channels < kMostJoinedNumbers))
    throw InputError(
        {file.file, 0},
        fmt::format("would have {:.3g} samples of {:.0f} channels at a step of {:g} s; expected a "
                    "larger step, such as {:.6g} s, the one of group {}",
                    steps + 1.0,
                    channels,
                    step,
                    mean_step(fastest),
                    in_quotes(fastest.group->name)));
  if (steps < 1.0)
    throw InputError(
        {file.file, 0},
        fmt::format("would have one sample at a step of {:g} s, because its groups share "
                    "{:g} s; expected a smaller step",
                    step,
                    last - first));
  std::vector<double> grid(static_cast<std::size_t>(steps) + 1);
  for (std::size_t i = 0; i < grid.size(); ++i)
    grid[i] = std::min(first + static_cast<double>(i) * step, last);
  RecordedGroup joined{"", {}, true};
  std::set<std::string> names;
  for (const TimedGroup& one : timed)
    for (std::size_t k = 1; k < one.group->channels.size(); ++k) {
      RecordedChannel channel = std::move(one.group->channels[k]);
      channel.values = at_times(one.time, channel.values, grid);
      if (!names.insert(channel.name).second || channel.name == "time") {
        channel.name += " @ " + one.group->name;
        names.insert(channel.name);
      }
      joined.channels.push_back(std::move(channel));
    }
  joined.channels.insert(
      joined.channels.begin(),
      {"time",
       "s",
       std::move(grid),
       fmt::format("{} groups at a step of {:g} s, linear between samples", timed.size(), step)});
  tell_equal_names_apart(joined);
  return joined;
}

}  // namespace

LabTable recorder_table(RecordedFile file,
                        const std::map<std::string, std::string>& units,
                        const ExpectedUnit& expected,
                        const std::string& part,
                        double step) {
  LabTable table;
  table.file = file.file;
  table.header = {file.file, 0};
  table.part_word = "group";
  for (const std::string& doubt : file.doubts) table.doubts.push_back({"", doubt, table.header});
  if (!part.empty() && step > 0.0)
    throw InputError(table.header,
                     "is to be read as group " + in_quotes(part) +
                         " and resampled, expected one of the two: resample joins all groups");
  RecordedGroup group =
      step > 0.0 ? joined_groups(file, step, table) : chosen_group(file, part, table);
  std::map<std::string, std::string> remarks;
  std::vector<LabColumn> columns;
  for (RecordedChannel& channel : group.channels) {
    LabColumn column;
    column.source = {.name = channel.name, .unit = channel.unit, .title = channel.name};
    column.source.place = static_cast<int>(columns.size() + 1);
    column.source.unit_place = UnitPlace::field;
    column.values = std::move(channel.values);
    remarks[channel.name] = channel.remark;
    columns.push_back(std::move(column));
  }
  for (const auto& [name, why] : file.left_out)
    if (units.contains(name)) throw InputError(table.header, in_quotes(name) + " " + why);
  add_columns(std::move(columns), units, expected, table.header, table);
  for (TableColumn& column : table.columns)
    if (const std::string& remark = remarks[column.title]; !remark.empty())
      column.assumed += (column.assumed.empty() ? "" : "; ") + remark;
  for (const auto& [name, why] : file.left_out)
    if (!table.channels.find(name) && table.left_out.insert({name, why}).second)
      table.left_columns.push_back({.name = name, .title = name});
  return table;
}

}  // namespace latsch::formats
