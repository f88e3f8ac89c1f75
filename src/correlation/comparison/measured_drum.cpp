// SPDX-License-Identifier: Apache-2.0
#include "correlation/comparison/measured_drum.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "correlation/comparison/comparison_file.h"
#include "correlation/observable/compared_frame.h"
#include "measurement/meaning/wheel_load.h"

namespace latsch::correlation {
namespace {

constexpr double kSameTime = 1e-9;  // s
constexpr double kGap = 1.5;        // median steps; a larger step between two samples is a gap

/// Returns the median step of the recording, s.
double checked_step(const Measurement& table, const std::vector<double>& time) {
  if (time.size() < 2)
    throw InputError(table.place(),
                     fmt::format("has {} of the recording; expected the samples of a drum test",
                                 time.empty() ? "no row" : "one row"));
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) {
    steps.push_back(time[i] - time[i - 1]);
    if (!(steps.back() > 0.0))
      throw InputError(table.place(i),
                       fmt::format("time goes from {:.6g} s to {:.6g} s, expected rising times: "
                                   "cut the file there, or write more digits",
                                   time[i - 1],
                                   time[i]));
  }
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double median = *middle;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] > kGap * median)
      throw InputError(table.place(i + 1),
                       fmt::format("{:.0f} samples are missing between {:.6g} s and {:.6g} s: fill "
                                   "the gap or cut the file there",
                                   steps[i] / median - 1.0,
                                   time[i],
                                   time[i + 1]));
  return median;
}

/// Returns y at the times of the test, linear between its samples.
std::vector<double> at_times(const Measurement& table,
                             const std::vector<double>& t,
                             const std::vector<double>& y,
                             const std::vector<double>& times) {
  std::vector<double> values;
  for (const double at : times) {
    const auto right = std::lower_bound(t.begin(), t.end(), at - kSameTime);
    if (right == t.end() || (right == t.begin() && *right > at + kSameTime)) {
      throw InputError(
          table.place(),
          fmt::format("reaches from {:g} to {:g} s, but the test is compared at {:g} s; shorten "
                      "lead or duration of the test, or measure longer",
                      t.front(),
                      t.back(),
                      at));
    }
    const auto i = static_cast<std::size_t>(right - t.begin());
    if (i == 0 || t[i] <= at) {
      values.push_back(y[i]);
      continue;
    }
    const double share = (at - t[i - 1]) / (t[i] - t[i - 1]);
    values.push_back(y[i - 1] + share * (y[i] - y[i - 1]));
  }
  return values;
}

void check_force(const Measurement& table,
                 const std::string& channel,
                 const std::vector<double>& y,
                 std::optional<double> load) {
  const auto reject = [&](const std::string& why) {
    throw InputError(table.place(), "column \"" + channel + "\" " + why);
  };
  const auto [least, most] = std::minmax_element(y.begin(), y.end());
  if (*least == *most)
    reject(
        fmt::format("is {:g} in all samples of the test, so there is nothing to compare; was "
                    "its sensor connected? Leave it out of channels",
                    *least));
  if (const auto reason = impossible_load(y)) reject(*reason);
  if (const auto reason = negative_load(channel, y))
    reject(*reason + " Turn its signs to those of the test");
  if (const auto reason = unlike_load(channel, y, load))
    reject(*reason + " State the unit in its header, or in columns of a [measurement.NAME]");
}

/// Throws InputError if the recording has the channel in another frame than the test.
void check_frame(const Measurement& table, const std::string& channel, AxisFrame frame) {
  const std::string recorded = table.frame(channel), of_test = name_of(frame);
  if (recorded.empty() || is_same_in(channel, recorded, of_test)) return;
  throw InputError(
      table.place(),
      fmt::format("column {} is in axes {}, but the test records {} in axes {}: put in_frame = "
                  "\"{}\" into {}, or frame = \"{}\" into the file of the test",
                  in_quotes(table.written(channel).column),
                  recorded,
                  channel,
                  of_test,
                  of_test,
                  table.is_stated() ? "[measurement." + table.name() + "]"
                                    : "a [measurement.NAME] of the recording, which the test "
                                      "names instead of the file",
                  recorded));
}

}  // namespace

MeasuredDrum measured_drum(const Measurement& recording,
                           const std::vector<std::string>& channels,
                           const std::vector<double>& times,
                           AxisFrame frame,
                           std::optional<double> load) {
  const auto& time = recording.values("time", "s");
  MeasuredDrum measured;
  measured.highest = 0.5 / checked_step(recording, time);
  for (const std::string& channel : channels) {
    const auto& force = recording.values(channel, unit_of(channel));
    check_frame(recording, channel, frame);
    measured.forces.push_back(at_times(recording, time, force, times));
    check_force(recording, channel, measured.forces.back(), load);
  }
  return measured;
}

}  // namespace latsch::correlation
