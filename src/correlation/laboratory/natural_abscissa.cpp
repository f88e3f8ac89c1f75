// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/natural_abscissa.h"

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
// Share of the usual range: smaller variation is scatter of the rig.
constexpr double kVaries = 0.05;
// Share of a condition's range: a gap of this size separates two levels.
constexpr double kApart = 0.15;
// Share of a condition's range: a gap of this size also separates two levels, provided that it is
// kDistinct times as large as the gaps within the levels and that each level has at least kFilled
// samples on average.
constexpr double kNear = 0.05;
constexpr double kDistinct = 3.0;
constexpr std::size_t kFilled = 4;
// Samples per level below which values form no levels: for example a load that rises with the
// travel of a rig is a result, not a condition.
constexpr std::size_t kSparse = 2;
// Largest number of levels: a condition with more is a sweep and forms no groups.
constexpr std::size_t kMostLevels = 8;

// Largest number of groups of which each has a color and a row of the legend of its own.
constexpr std::size_t kMostColors = 7;

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

/// Returns the first value of every level but the lowest. `sorted` rises.
std::vector<double> level_starts(const std::vector<double>& sorted) {
  const double range = sorted.back() - sorted.front();
  std::vector<double> wide, near;
  // the widest gap within a level, the narrowest between levels
  double inside = 0.0, between = range;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap > kApart * range) wide.push_back(sorted[i]);
    if (gap > kNear * range) {
      near.push_back(sorted[i]);
      between = std::min(between, gap);
    } else {
      inside = std::max(inside, gap);
    }
  }
  const bool are_distinct = near.size() < kMostLevels && between > kDistinct * inside &&
                            sorted.size() >= kFilled * (near.size() + 1);
  if (are_distinct) return near;
  return sorted.size() >= kSparse * (wide.size() + 1) ? wide : std::vector<double>{};
}

/// Returns the first value of every level but the lowest of values that a rig sets, however few
/// there are at each level: values closer than kVaries of a range follow each other within a level.
/// Returns no levels if there are more than kMostLevels, as in a sweep, or if one of them has less
/// than kStray of all samples.
std::vector<double> set_starts(const std::vector<double>& sorted, double range) {
  constexpr double kStray = 0.01;
  std::vector<double> starts;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= sorted.size(); ++i) {
    if (i < sorted.size() && sorted[i] - sorted[i - 1] <= kVaries * range) continue;
    if (static_cast<double>(i - begin) < kStray * static_cast<double>(sorted.size())) return {};
    if (i < sorted.size()) starts.push_back(sorted[i]);
    begin = i;
  }
  return starts.size() + 1 <= kMostLevels ? starts : std::vector<double>{};
}

/// Returns the level of every value, counted from the lowest; all 0 if levels cannot be
/// distinguished. `are_set`: the rig sets the values, so that few samples at a level do not make it
/// a result of something else.
std::vector<int> levels_of(const std::vector<double>& values,
                           double usual_range,
                           bool are_set = false) {
  std::vector<int> levels(values.size(), 0);
  const double range = range_of(values);
  if (range < kVaries * usual_range) return levels;
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> starts = level_starts(sorted);
  if (are_set)
    if (auto set = set_starts(sorted, usual_range); set.size() > starts.size())
      starts = std::move(set);
  if (starts.size() + 1 > kMostLevels) return levels;
  for (std::size_t i = 0; i < values.size(); ++i)
    levels[i] = static_cast<int>(std::upper_bound(starts.begin(), starts.end(), values[i]) -
                                 starts.begin());
  return levels;
}

/// Returns the candidate that was swept; nullptr if no candidate varies. This is the one that
/// covers the largest share of its usual range. If several candidates cover similar shares, it is
/// the one with the most levels, because a channel with few levels is a condition: camber of 0, 2,
/// 4 and 6 deg during a sweep of slip, for example. `are_set`: the rig sets the candidates, so that
/// few values are levels even if each has a single sample.
template <std::size_t N>
const Usual* swept(const std::array<Usual, N>& candidates,
                   const Measurement& measurement,
                   const std::string& y,
                   bool are_set) {
  // two shares are similar if one is at least this part of the other
  constexpr double kSimilar = 1.0 / 3.0;
  struct Candidate {
    const Usual* channel;
    double share;  // range over the usual range
    int levels;    // number of levels; for a continuous channel more than any condition has
  };
  std::vector<Candidate> all;
  double most = kVaries;
  for (const Usual& one : candidates) {
    if (y == one.name || force_without_frame(y) == one.name) continue;
    const auto values = values_of(measurement, one.name);
    const double share = values ? range_of(*values) / one.range : 0.0;
    if (share <= kVaries) continue;
    most = std::max(most, share);
    const std::vector<int> levels = levels_of(*values, one.range);
    int highest = *std::max_element(levels.begin(), levels.end());
    if (highest == 0 && are_set) {
      std::vector<double> sorted = *values;
      std::sort(sorted.begin(), sorted.end());
      highest = static_cast<int>(set_starts(sorted, range_of(sorted)).size());
    }
    all.push_back({&one, share, highest == 0 ? static_cast<int>(kMostLevels) : highest});
  }
  const Candidate* found = nullptr;
  for (const Candidate& one : all) {
    if (one.share < kSimilar * most) continue;
    if (!found || one.levels > found->levels ||
        (one.levels == found->levels && one.share > found->share))
      found = &one;
  }
  return found ? found->channel : nullptr;
}

struct Condition {
  std::string name, shown;
  std::vector<double> values;
  std::vector<int> levels;
};

std::vector<Condition> conditions_of(const Measurement& measurement, const std::string& x) {
  std::vector<Condition> all;
  // A flat track sets load, inclination and pressure; on a K&C rig they may follow its travel.
  const bool are_set =
      std::ranges::any_of(kSlips, [&](const Usual& slip) { return x == slip.name; });
  for (const Usual& one : kConditions) {
    if (x == one.name) continue;
    auto values = values_of(measurement, one.name);
    if (!values) continue;
    auto levels = levels_of(*values, one.range, are_set);
    if (*std::max_element(levels.begin(), levels.end()) == 0) continue;
    const std::string usual = read_unit(measurement.unit(one.name));
    all.push_back({one.name,
                   unit_of_file(measurement, one.name, usual),
                   std::move(*values),
                   std::move(levels)});
  }
  return all;
}

/// Returns the name of a level, such as "Fz 1050 N": the mean of its samples, rounded to the digits
/// in which levels differ.
std::string name_of(const Condition& one, int level) {
  const Unit unit = Unit::of(one.shown);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    if (one.levels[i] != level) continue;
    sum += one.values[i];
    count += 1.0;
  }
  const double range = unit.from_si(range_of(one.values)) - unit.from_si(0.0);
  const double step = std::pow(10.0, std::floor(std::log10(0.01 * range)));
  const double shown = std::round(unit.from_si(sum / count) / step) * step + 0.0;  // 0, not -0
  return one.name + " " + format_quantity(unit.to_si(shown), one.shown, 6);
}

void sort_into_groups(const std::vector<Condition>& conditions, NaturalAbscissa& abscissa) {
  std::map<std::vector<int>, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < abscissa.values.size(); ++i) {
    std::vector<int> levels;
    for (const Condition& one : conditions) levels.push_back(one.levels[i]);
    groups[levels].push_back(i);
  }
  for (auto& [levels, samples] : groups) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < conditions.size(); ++k)
      names.push_back(name_of(conditions[k], levels[k]));
    std::stable_sort(samples.begin(), samples.end(), [&](std::size_t a, std::size_t b) {
      return abscissa.values[a] < abscissa.values[b];
    });
    const std::size_t from = abscissa.order.size();
    abscissa.order.insert(abscissa.order.end(), samples.begin(), samples.end());
    abscissa.groups.push_back({fmt::format("{}", fmt::join(names, ", ")),
                               names.empty() ? "" : names.front(),
                               from,
                               abscissa.order.size()});
  }
  if (abscissa.groups.size() <= kMostColors)
    for (NaturalAbscissa::Group& group : abscissa.groups) group.level = group.name;
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
  const Usual* found = swept(kSlips, measurement, y, /*are_set=*/true);
  if (!found) found = swept(kMoved, measurement, y, /*are_set=*/false);
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
