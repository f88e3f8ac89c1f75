// SPDX-License-Identifier: Apache-2.0
#include "correlation/observable/natural_abscissa.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "base/unit_reading.h"
#include "base/units.h"

namespace latsch::correlation {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kVaries = 0.05;        // share of the usual range: smaller variation is the rig's
                                        // scatter
constexpr double kApart = 0.15;         // share of a condition's range: a gap of this size
                                        // separates two levels
constexpr std::size_t kMostLevels = 8;  // a condition with more levels is a sweep and forms no
                                        // groups

struct Usual {
  const char* name;
  double range;  // usual range in a test, SI
};
constexpr std::array kSlips = {
    Usual{"alpha", 24.0 * kDegree}, Usual{"kappa", 0.4}, Usual{"gamma", 12.0 * kDegree}};
constexpr std::array kMoved = {Usual{"dz", 0.1},
                               Usual{"Fz", 4e3},
                               Usual{"Fy", 3e3},
                               Usual{"Fx", 3e3},
                               Usual{"Mz", 200.0},
                               Usual{"steer", 60.0 * kDegree}};
constexpr std::array kConditions = {
    Usual{"Fz", 2e3}, Usual{"gamma", 6.0 * kDegree}, Usual{"p", 1e5}};

double range_of(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

std::optional<std::vector<double>> values_of(const Measurement& measurement, const char* name) {
  if (!measurement.has(name)) return std::nullopt;
  const Channel* found = measurement.channels().find(name);
  if (!found)
    for (const Channel& channel : measurement.channels().all())
      if (force_without_frame(channel.name) == name) found = &channel;
  if (!found || !std::all_of(found->values.begin(), found->values.end(), [](double x) {
        return std::isfinite(x);
      }))
    return std::nullopt;
  return found->values;
}

/// Returns the candidate that covers the most of its usual range; nullptr if none varies.
template <std::size_t N>
const Usual* widest(const std::array<Usual, N>& candidates,
                    const Measurement& measurement,
                    const std::string& y) {
  const Usual* found = nullptr;
  double most = kVaries;
  for (const Usual& one : candidates) {
    if (y == one.name || force_without_frame(y) == one.name) continue;
    const auto values = values_of(measurement, one.name);
    const double share = values ? range_of(*values) / one.range : 0.0;
    if (share <= most) continue;
    most = share;
    found = &one;
  }
  return found;
}

/// Returns the level of every value, counted from the lowest; all 0 if levels cannot be
/// distinguished.
std::vector<int> levels_of(const std::vector<double>& values, double usual_range) {
  std::vector<int> levels(values.size(), 0);
  const double range = range_of(values);
  if (range < kVaries * usual_range) return levels;
  std::vector<double> sorted = values, starts = {};
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > kApart * range) starts.push_back(sorted[i]);
  if (starts.size() + 1 > kMostLevels) return levels;
  for (std::size_t i = 0; i < values.size(); ++i)
    levels[i] = static_cast<int>(std::upper_bound(starts.begin(), starts.end(), values[i]) -
                                 starts.begin());
  return levels;
}

struct Condition {
  std::string name, shown;
  std::vector<double> values;
  std::vector<int> levels;
};

std::vector<Condition> conditions_of(const Measurement& measurement, const std::string& x) {
  std::vector<Condition> all;
  for (const Usual& one : kConditions) {
    if (x == one.name) continue;
    auto values = values_of(measurement, one.name);
    if (!values) continue;
    auto levels = levels_of(*values, one.range);
    if (*std::max_element(levels.begin(), levels.end()) == 0) continue;
    const std::string usual = read_unit(measurement.unit(one.name));
    all.push_back({one.name,
                   unit_of_file(measurement, one.name, usual),
                   std::move(*values),
                   std::move(levels)});
  }
  return all;
}

/// Returns the means over the samples of a group: "Fz 1050 N, gamma 2 deg".
std::string name_of(const std::vector<Condition>& conditions,
                    const std::vector<std::size_t>& samples) {
  std::vector<std::string> parts;
  for (const Condition& one : conditions) {
    double sum = 0.0;
    for (const std::size_t i : samples) sum += one.values[i];
    // A level is written with the digits in which levels differ; the rest is the rig's scatter.
    const double step = 0.01 * range_of(one.values);
    const double level = std::round(sum / static_cast<double>(samples.size()) / step) * step;
    parts.push_back(one.name + " " + format_quantity(level, one.shown, 4));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void sort_into_groups(const std::vector<Condition>& conditions, NaturalAbscissa& abscissa) {
  std::map<std::vector<int>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < abscissa.values.size(); ++i) {
    std::vector<int> levels;
    for (const Condition& one : conditions) levels.push_back(one.levels[i]);
    groups[levels].push_back(i);
  }
  for (auto& [levels, samples] : groups) {
    std::stable_sort(samples.begin(), samples.end(), [&](std::size_t a, std::size_t b) {
      return abscissa.values[a] < abscissa.values[b];
    });
    const std::size_t from = abscissa.order.size();
    abscissa.order.insert(abscissa.order.end(), samples.begin(), samples.end());
    abscissa.groups.push_back({name_of(conditions, samples), from, abscissa.order.size()});
  }
}

}  // namespace

std::string unit_of_file(const Measurement& measurement,
                         const std::string& channel,
                         const std::string& otherwise) {
  const std::string& written = measurement.written(channel).unit;
  if (written.empty()) return otherwise;
  const auto unit = find_unit(written, Unit::of(measurement.unit(channel)));
  if (!unit || !unit->same_dimension(Unit::of(measurement.unit(channel)))) return otherwise;
  return Unit::find(unit->text()) ? unit->text() : otherwise;
}

std::optional<NaturalAbscissa> natural_abscissa(const Measurement& measurement,
                                                const std::string& y) {
  if (measurement.samples() == 0) return std::nullopt;
  const Usual* found = widest(kSlips, measurement, y);
  if (!found) found = widest(kMoved, measurement, y);
  if (!found) return std::nullopt;
  NaturalAbscissa abscissa;
  abscissa.channel = found->name;
  abscissa.unit = measurement.unit(found->name);
  abscissa.shown = unit_of_file(measurement, found->name, read_unit(abscissa.unit));
  abscissa.values = *values_of(measurement, found->name);
  sort_into_groups(conditions_of(measurement, found->name), abscissa);
  return abscissa;
}

}  // namespace latsch::correlation
