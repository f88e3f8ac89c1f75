// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/measurement_zero.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/document_record.h"
#include "base/text.h"
#include "base/units.h"
#include "correlation/laboratory/record_ledger.h"
#include "correlation/laboratory/selection.h"

namespace latsch::correlation {
namespace {

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::abs(value) > largest) largest = std::abs(value);
  return largest;
}

/// Adds a doubt about a subtracted mean that is probably no zero offset of a sensor: it is a large
/// part of the measured values, or the mean of only a few samples.
void doubt_zero(const TakenZero& taken,
                const Channel& channel,
                double largest,
                const Place& place,
                LabRecord& record) {
  // largest offset that is not doubted; share of the largest value
  constexpr double kMostOffset = 0.2;
  constexpr std::size_t kFewestSamples = 5;
  std::string why;
  if (std::abs(taken.mean) > kMostOffset * largest)
    why = fmt::format("{:.0f} % of its largest value, {}: a load is taken off, not an offset",
                      100.0 * std::abs(taken.mean) / largest,
                      format_quantity(largest, channel.unit, 4));
  else if (taken.samples < kFewestSamples)
    why = fmt::format("the mean of {} sample{}, whose noise moves all others",
                      taken.samples,
                      taken.samples == 1 ? "" : "s");
  if (why.empty()) return;
  record.ledgers.front().doubts.push_back(
      {record.written.at(channel.name).column,
       fmt::format("zero takes {} off {}, {}; expected a time at which {} is 0",
                   format_quantity(taken.mean, channel.unit, 4),
                   channel.name,
                   why,
                   channel.name),
       place});
}

/// Removes from a mask the samples outside of the window that a key of the table states.
void stay_within(const Node& table,
                 const std::string& key,
                 LabRecord& record,
                 std::vector<bool>& mask) {
  DocumentRecord::expects(table, key, R"(a window such as "0 s .. 2 s")");
  const Channel& channel = channel_of(table, key, record);
  const auto [window, fault] = parse_window(table.text(key), channel.unit);
  if (!window) table.reject(key, "is " + in_quotes(table.text(key)) + ", " + fault);
  note_use(record, key, "zero");
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = mask[i] && channel.values[i] >= window->from && channel.values[i] <= window->to;
  if (std::find(mask.begin(), mask.end(), true) == mask.end())
    table.reject(key,
                 "is " + in_quotes(table.text(key)) + ", which holds no sample; " + key + " goes " +
                     range_in_words(channel));
}

}  // namespace

Channel& channel_of(const Node& table, const std::string& key, LabRecord& record) {
  if (Channel* channel = record.find(key)) return *channel;
  const auto reason = record.left_out.find(key);
  table.reject(key,
               reason != record.left_out.end()
                   ? "is no channel: it " + reason->second
                   : "is no channel" + did_you_mean(key, record.names()) +
                         " (channels: " + list_of(record.names()) + ")");
}

void read_zero(const Node& table, LabRecord& record, std::vector<std::string>& words) {
  const auto zero = table.find_table("zero");
  if (!zero) return;
  std::vector<bool> mask(record.samples(), true);
  const auto at = zero->find_table("at");
  if (at)
    for (const std::string& key : at->keys()) stay_within(*at, key, record, mask);
  if (!at || zero->has("time")) {
    (void)zero->text("time");  // the key is required if there is no table `at`
    if (record.time().empty()) zero->reject("time", "needs a channel time, and there is none");
    stay_within(*zero, "time", record, mask);
  }
  for (const std::string& name : zero->texts("channels")) {
    Channel* channel = record.find(name);
    if (!channel)
      zero->reject(
          "channels",
          "has " + in_quotes(name) + ", which is no channel" + did_you_mean(name, record.names()));
    note_use(record, name, "zero");
    const double largest = largest_magnitude(channel->values);
    const auto taken = take_zero(*channel, mask);
    if (!taken)
      zero->reject("channels",
                   "has " + in_quotes(name) + ", which is empty in all samples of the zero");
    words.push_back(fmt::format("{} less {}, the mean of {} samples",
                                channel->name,
                                format_quantity(taken->mean, channel->unit, 4),
                                taken->samples));
    const bool is_motion = channel->unit == "rad" || channel->unit == "m";
    // Recordings often contain motions as absolute values, whose large values at rest are to be
    // subtracted.
    if (!at || !is_motion)
      doubt_zero(*taken, *channel, largest, zero->place(at ? "at" : "time"), record);
  }
}

}  // namespace latsch::correlation
