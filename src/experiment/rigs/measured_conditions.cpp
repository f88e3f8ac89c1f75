// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/measured_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/document_record.h"
#include "base/text.h"
#include "base/units.h"

namespace latsch::experiment {
namespace {

/// Returns the values of the only channel of a table.
std::vector<double> samples_of(const Node& table,
                               MeasuredCondition condition,
                               const MeasuredConditions& measured) {
  condition.is_needed = true;
  auto values = take_measured(table, {condition}, measured).all().front().values;
  if (values.empty()) table.reject("from", "has no sample of " + condition.channel);
  return values;
}

/// If one channel was requested, returns the list that a person might have written instead; else
/// every channel by its name.
std::string canonical_text(const Channels& channels, std::size_t asked) {
  if (asked == 1 && channels.all().size() == 1)
    return canonical(channels.all()[0].values, channels.all()[0].unit);
  std::string text;
  for (const Channel& channel : channels.all())
    text +=
        (text.empty() ? "" : ", ") + channel.name + " = " + canonical(channel.values, channel.unit);
  return "{" + text + "}";
}

}  // namespace

std::optional<Node> find_measured(const Node& test, std::string_view key) {
  DocumentRecord::may_be_measured(test, key);
  try {
    const auto table = test.find_table(key);
    if (table && table->has("from")) return table;
  } catch (const InputError&) {  // the key holds a quantity or a list
  }
  return std::nullopt;
}

Channels take_measured(const Node& table,
                       const std::vector<MeasuredCondition>& conditions,
                       const MeasuredConditions& measured) {
  if (!measured)
    table.reject("from",
                 "is " + in_quotes(table.text("from")) + ", which only a test of a study can name");
  Channels channels = measured(table, conditions);
  DocumentRecord::stands_for(table, canonical_text(channels, conditions.size()));
  return channels;
}

std::vector<double> measured_values(const Node& table,
                                    const MeasuredCondition& condition,
                                    const MeasuredConditions& measured) {
  const auto values = samples_of(table, condition, measured);
  const auto wrong =
      std::find_if(values.begin(), values.end(), [](double value) { return !(value > 0.0); });
  if (wrong != values.end())
    table.reject("from",
                 fmt::format("is {}, whose {} is {} in sample {}, expected above 0; leave such "
                             "samples out by a [measurement.NAME.select]",
                             in_quotes(table.text("from")),
                             condition.channel,
                             format_quantity(*wrong, condition.unit),
                             wrong - values.begin() + 1));
  return values;
}

double measured_mean(const Node& table,
                     const MeasuredCondition& condition,
                     const MeasuredConditions& measured) {
  // largest ratio of standard deviation to mean for a condition that counts as constant; rigs keep
  // speed and load more constant
  constexpr double kHeld = 0.05;
  const auto values = samples_of(table, condition, measured);
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (!(mean > 0.0) || std::sqrt(squares / count) > kHeld * mean)
    table.reject("from",
                 fmt::format("is {}, whose {} goes from {} to {}, expected a constant one above "
                             "0, because its mean is used; select the right samples",
                             in_quotes(table.text("from")),
                             condition.channel,
                             format_quantity(*least, condition.unit, 4),
                             format_quantity(*most, condition.unit, 4)));
  DocumentRecord::stands_for(table, canonical(mean, condition.unit));
  return mean;
}

long measured_count(const Node& table,
                    const MeasuredCondition& condition,
                    const MeasuredConditions& measured) {
  const long count = std::ssize(samples_of(table, condition, measured));
  DocumentRecord::stands_for(table, std::to_string(count));
  return count;
}

Eigen::Matrix3Xd measured_points(const Node& table, const MeasuredConditions& measured) {
  const Channels channels =
      take_measured(table,
                    {{"x", "m", true}, {"y", "m", true}, {"z", "m", true}, {"mode", "1", false}},
                    measured);
  const Channel* mode = channels.find("mode");
  std::vector<std::vector<double>> rows;
  std::vector<double> points;
  for (std::size_t i = 0; i < channels["x"].size(); ++i) {
    if (mode && mode->values[i] != mode->values[0]) continue;
    rows.push_back({channels["x"][i], channels["y"][i], channels["z"][i]});
    points.insert(points.end(), rows.back().begin(), rows.back().end());
  }
  DocumentRecord::stands_for(table, canonical(rows, {"m", "m", "m"}));
  return Eigen::Matrix3Xd::Map(points.data(), 3, std::ssize(points) / 3);
}

}  // namespace latsch::experiment
