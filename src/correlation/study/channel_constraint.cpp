// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/channel_constraint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/unit_reading.h"
#include "correlation/observable/channel_value.h"
#include "optimization/problem/score.h"

namespace latsch::correlation {
namespace {

static_assert(kFulfilled == 1e-4, "the header and docs/study_reference.md state this number");

std::string constrained_unit(const Node& table,
                             const std::string& channel,
                             const std::vector<KnownChannel>& channels) {
  std::vector<std::string> names;
  for (const KnownChannel& known : channels) {
    if (known.name == channel) return known.unit;
    names.push_back(known.name);
  }
  table.reject("channel",
               fmt::format("is {}, which no trial records{}; there are {}",
                           in_quotes(channel),
                           did_you_mean(channel, names),
                           list_of(names)));
}

/// Returns the unit in which the user wrote a bound.
std::string written_unit(const Node& table, const char* key, const std::string& unit) {
  if (unit == "1") return unit;
  const auto quantity = parse_quantity(table.text(key), Unit::of(unit));
  return quantity ? quantity->unit.text() : unit;
}

void read_bounds(const Node& table, const std::string& unit, ChannelConstraint& constraint) {
  const char* first = nullptr;
  for (const char* key : {"equal", "lower", "upper"}) {
    if (!table.has(key)) continue;
    const double value = table.quantity(key, unit);
    if (key != std::string_view("upper")) constraint.lower = value;
    if (key != std::string_view("lower")) constraint.upper = value;
    if (!first) first = key;
  }
  if (!first) table.reject("lower", "is missing, expected lower, upper or equal");
  if (first == std::string_view("equal") && (table.has("lower") || table.has("upper"))) {
    table.reject("equal", "is given beside lower or upper, expected it alone");
  }
  if (constraint.lower && constraint.upper && *constraint.lower > *constraint.upper) {
    table.reject("lower", "is above upper");
  }
  constraint.unit = written_unit(table, first, unit);
}

}  // namespace

ChannelConstraint read_channel_range(const Node& table, const std::vector<KnownChannel>& known) {
  ChannelConstraint range;
  range.name = table.name();
  range.channel = table.text("channel");
  const std::string unit = constrained_unit(table, range.channel, known);
  range.is_of_stated = table.has("of");
  range.of = table.choice("of", names_of_values(), "largest");
  read_bounds(table, unit, range);
  return range;
}

ChannelConstraint read_channel_constraint(const Node& table,
                                          const std::vector<KnownChannel>& known) {
  ChannelConstraint constraint = read_channel_range(table, known);
  const double size =
      std::max(std::abs(constraint.lower.value_or(0.0)), std::abs(constraint.upper.value_or(0.0)));
  if (!table.has("scale") && !(size > 0.0)) {
    table.reject("scale",
                 "is missing: if all bounds are 0, they give no scale; expected a positive value");
  }
  constraint.scale = table.quantity("scale", constraint.unit, Range::positive(), size);
  return constraint;
}

Result<double> value_of(const ChannelConstraint& constraint, const Channels& channels) {
  const Channel* channel = channels.find(constraint.channel);
  if (!channel || channel->values.empty()) {
    return Failure{fmt::format("constraint \"{}\": the trial has no values of {}",
                               constraint.name,
                               constraint.channel),
                   Cause::bad_output};
  }
  if (channel->values.size() > 1 && constraint.lower && !constraint.is_of_stated)
    return Failure{fmt::format("constraint \"{}\": {} has {} values, and a lower bound on the "
                               "largest, which holds unless the key `of` says otherwise, may leave "
                               "others below it: expected of = \"smallest\" or {}",
                               constraint.name,
                               constraint.channel,
                               channel->values.size(),
                               list_of({"largest", "mean", "first", "last"})),
                   Cause::bad_output};
  const double y = value_of(constraint.of, channel->values);
  if (!std::isfinite(y)) {
    return Failure{
        fmt::format("constraint \"{}\": {} is {}", constraint.name, constraint.channel, y),
        Cause::bad_output};
  }
  return y;
}

Status apply(const ChannelConstraint& constraint, const Channels& channels, Score& score) {
  const auto value = value_of(constraint, channels);
  if (!value) return value.failure();
  const double y = *value;
  if (constraint.is_equation()) {
    score.equations.push_back((y - *constraint.upper) / constraint.scale);
    return {};
  }
  if (constraint.lower) score.constraints.push_back((*constraint.lower - y) / constraint.scale);
  if (constraint.upper) score.constraints.push_back((y - *constraint.upper) / constraint.scale);
  return {};
}

std::string in_words(const ChannelConstraint& constraint) {
  std::string text = constraint.of + " " + constraint.channel;
  const auto bound = [&](double value) { return format_quantity(value, constraint.unit); };
  if (constraint.is_equation()) return text + " = " + bound(*constraint.upper);
  if (constraint.lower) text = bound(*constraint.lower) + " <= " + text;
  if (constraint.upper) text += " <= " + bound(*constraint.upper);
  return text;
}

}  // namespace latsch::correlation
