// SPDX-License-Identifier: Apache-2.0
#include "measurement/meaning/rest_offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/units.h"
#include "measurement/meaning/channel_words.h"
#include "measurement/meaning/projection.h"

namespace latsch {
namespace {

using Values = std::vector<double>;

// share of the largest value of a load up to which the load counts as 0; with a larger share the
// load would have moved the wheel in some of these samples
constexpr double kAtRest = 0.05;

double largest(const Values& values) {
  double most = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

/// A channel that the rig prescribes, and the magnitude up to which its values count as 0.
struct Driver {
  const Channel* channel;
  double rest;
};

/// Returns the channels that the rig prescribes and that are not 0 in all samples.
std::vector<Driver> drivers_in(const Channels& channels) {
  constexpr std::array<std::string_view, 8> kDrivers = {
      "Fx", "Fy", "Fz", "Mx", "My", "Mz", "travel", "rack"};
  std::vector<Driver> drivers;
  for (const Channel& channel : channels.all()) {
    const auto known = recognized(channel.name);
    const bool is_driver =
        known &&
        std::find(kDrivers.begin(), kDrivers.end(), known->meaning->name) != kDrivers.end();
    const double most = largest(channel.values);
    if (is_driver && channel.unit == known->meaning->unit && most > 0.0)
      drivers.push_back({&channel, kAtRest * most});
  }
  return drivers;
}

bool is_at_rest(const std::vector<Driver>& drivers, std::size_t i) {
  return std::all_of(drivers.begin(), drivers.end(), [&](const Driver& one) {
    return std::abs(one.channel->values[i]) <= one.rest;
  });
}

/// Returns the constant c of the plane y = c + sum b_k x_k that is fitted by least squares to y
/// over the drivers x_k; 0 if the drivers hardly vary.
double constant_of_plane(const Values& y, std::vector<Values> drivers) {
  // smallest share of a constant column that the drivers must leave unexplained
  constexpr double kLeastOwn = 0.05;
  Values one(y.size(), 1.0);
  for (std::size_t k = 0; k < drivers.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) project_out(drivers[j], drivers[k]);
    project_out(drivers[k], one);
  }
  const double own = dot(one, one);
  return own > kLeastOwn * static_cast<double>(y.size()) ? dot(one, y) / own : 0.0;
}

}  // namespace

std::vector<RestOffset> offsets_at_rest(const Channels& channels,
                                        const std::vector<std::string>& moved) {
  // share of the range; with a smaller share, hysteresis and the curvature of a table would be
  // mistaken for offsets
  constexpr double kClearly = 0.5;
  std::vector<RestOffset> offsets;
  const auto drivers = drivers_in(channels);
  if (drivers.empty()) return offsets;
  for (const std::string& name : moved) {
    const Channel* channel = channels.find(name);
    if (!channel) continue;
    Values y;
    std::vector<Values> x(drivers.size());
    double at_rest = 0.0;
    RestOffset found{name};
    for (std::size_t i = 0; i < channel->values.size(); ++i) {
      double sum = channel->values[i];
      for (const Driver& driver : drivers) sum += driver.channel->values[i];
      if (!std::isfinite(sum)) continue;
      y.push_back(channel->values[i]);
      for (std::size_t k = 0; k < drivers.size(); ++k)
        x[k].push_back(drivers[k].channel->values[i]);
      if (!is_at_rest(drivers, i)) continue;
      at_rest += y.back();
      ++found.samples;
    }
    if (y.size() < drivers.size() + 2) continue;
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    found.range = *high - *low;
    found.offset = found.samples > 0 ? at_rest / static_cast<double>(found.samples)
                                     : constant_of_plane(y, std::move(x));
    if (std::abs(found.offset) > kClearly * found.range) offsets.push_back(std::move(found));
  }
  return offsets;
}

std::string rest_windows(const Channels& channels) {
  constexpr int kDigits = 3;
  constexpr double kMargin = 1.01;  // factor that allows for rounding in the text
  const auto drivers = drivers_in(channels);
  std::string text;
  for (const auto& [channel, rest] : drivers)
    text += fmt::format("{}{} = \"0 {} +- {}\"",
                        text.empty() ? "" : ", ",
                        channel->name,
                        channel->unit,
                        format_quantity(kMargin * rest, channel->unit, kDigits));
  const std::size_t samples = drivers.empty() ? 0 : drivers.front().channel->values.size();
  for (std::size_t i = 0; i < samples; ++i)
    if (is_at_rest(drivers, i)) return "{" + text + "}";
  return "";
}

}  // namespace latsch
