// SPDX-License-Identifier: Apache-2.0
#include "measurement/drum_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"

namespace latsch {
namespace {

constexpr std::size_t kFewestSamples = 16;
constexpr double kUniform = 0.1;  // tolerance of the time step as a share of it

[[noreturn]] void reject(const std::string& source, const std::string& message) {
  throw InputError({source, 0}, message);
}

std::vector<std::string> names_of(const Channels& channels) {
  std::vector<std::string> names;
  for (const Channel& channel : channels.all()) names.push_back(channel.name);
  return names;
}

[[noreturn]] void missing(const Channels& channels,
                          const std::string& name,
                          const std::string& source) {
  const auto names = names_of(channels);
  reject(source,
         fmt::format("channel {} is missing{} (channels: {})",
                     in_quotes(name),
                     did_you_mean(name, names),
                     list_of(names)));
}

void expect_rising(const std::vector<double>& time, const std::string& source) {
  for (std::size_t i = 0; i + 1 < time.size(); ++i) {
    const double gap = time[i + 1] - time[i];
    if (gap <= 0.0) {
      reject(source,
             fmt::format("time goes from {:.6g} s to {:.6g} s behind sample {}, expected rising "
                         "times: cut the file there, or write more digits",
                         time[i],
                         time[i + 1],
                         i + 1));
    }
  }
}

void expect_no_gap(const std::vector<double>& time, const std::string& source) {
  // The median of the time steps is the recorder's step even if samples are missing.
  std::vector<double> steps(time.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = time[i + 1] - time[i];
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  const double median = steps[steps.size() / 2];
  for (std::size_t i = 0; i + 1 < time.size(); ++i) {
    const double gap = time[i + 1] - time[i];
    if (gap > 1.5 * median) {
      reject(source,
             fmt::format("{:.0f} samples are missing between {:.6g} s and {:.6g} s (sample {}): "
                         "fill the gap or cut the file there",
                         gap / median - 1.0,
                         time[i],
                         time[i + 1],
                         i + 1));
    }
  }
}

void expect_uniform(const std::vector<double>& time, double step, const std::string& source) {
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (std::abs(time[i] - time[0] - static_cast<double>(i) * step) > kUniform * step) {
      reject(source,
             fmt::format("time is not uniform: sample {} is at {:.9g} s, expected {:.9g} s for "
                         "steps of {:.6g} s; resample it to a constant rate",
                         i + 1,
                         time[i],
                         time[0] + static_cast<double>(i) * step,
                         step));
    }
  }
}

void check_values(const Channel& channel, std::size_t samples, const std::string& source) {
  if (channel.values.size() != samples) {
    reject(source,
           fmt::format("channel {} has {} values, expected {} as the time has",
                       in_quotes(channel.name),
                       channel.values.size(),
                       samples));
  }
  const auto bad = std::find_if_not(
      channel.values.begin(), channel.values.end(), [](double v) { return std::isfinite(v); });
  if (bad == channel.values.end()) return;
  const auto count =
      std::count_if(bad, channel.values.end(), [](double v) { return !std::isfinite(v); });
  reject(source,
         fmt::format("channel {} is not a finite number at sample {} ({} such samples): fill the "
                     "gap, cut the file there or leave the channel out",
                     in_quotes(channel.name),
                     bad - channel.values.begin() + 1,
                     count));
}

}  // namespace

std::span<const double> DrumRecord::channel(const std::string& name) const {
  const Channel* found = channels.find(name);
  if (!found) missing(channels, name, source);
  return found->values;
}

DrumRecord drum_record(const Channels& channels,
                       const std::string& time_channel,
                       std::string source) {
  const Channel* time = channels.find(time_channel);
  if (!time) missing(channels, time_channel, source);
  const std::vector<double>& t = time->values;
  if (t.size() < kFewestSamples) {
    reject(source, fmt::format("has {} samples, expected {} at least", t.size(), kFewestSamples));
  }
  for (const Channel& channel : channels.all()) check_values(channel, t.size(), source);
  const double step = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  expect_rising(t, source);
  // Gaps are searched first, because after a gap every later sample would seem to be late.
  expect_no_gap(t, source);
  expect_uniform(t, step, source);
  DrumRecord record;
  record.source = std::move(source);
  record.rate = 1.0 / step;
  record.start = t.front();
  record.samples = static_cast<int>(t.size());
  for (const Channel& channel : channels.all()) {
    if (channel.name != time_channel) record.channels.add(channel);
  }
  return record;
}

void expect_quantity(const DrumRecord& record,
                     const std::string& channel,
                     const std::string& unit) {
  (void)record.channel(channel);  // throws if the channel is missing
  const auto stated = Unit::find(record.channels.find(channel)->unit);
  const Unit expected = Unit::of(unit);
  if (!stated || stated->dimensionless() || stated->same_dimension(expected)) return;
  reject(record.source,
         fmt::format("channel {} is in {}, expected {}: is it the right channel, and its unit?",
                     in_quotes(channel),
                     stated->text(),
                     words_for(expected).noun));
}

void expect_varying(const DrumRecord& record, const std::string& channel) {
  const auto x = record.channel(channel);
  if (std::all_of(x.begin(), x.end(), [&](double v) { return v == x[0]; })) {
    reject(record.source,
           fmt::format("channel {} is {:g} all the time: was its sensor connected?",
                       in_quotes(channel),
                       x[0]));
  }
}

}  // namespace latsch
