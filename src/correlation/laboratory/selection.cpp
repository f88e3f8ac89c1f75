// SPDX-License-Identifier: Apache-2.0
#include "correlation/laboratory/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "base/unit_reading.h"

namespace latsch::correlation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns a number at one end of a window with its unit or, if it has no unit, with that of the
/// other end.
std::optional<Quantity> quantity_of(std::string_view text,
                                    std::string_view other,
                                    const Unit& expected) {
  const auto parts = split_number(text);
  if (!parts) return std::nullopt;
  std::string whole(text);
  if (parts->rest.empty()) {
    const auto others = split_number(other);
    whole += " " + std::string(others && !others->rest.empty() ? others->rest : "1");
  }
  return parse_quantity(whole, expected);
}

}  // namespace

std::pair<std::optional<Window>, std::string> parse_window(const std::string& text,
                                                           const std::string& unit) {
  const std::string example = "expected a window such as \"1 .. 2 " + (unit == "1" ? "" : unit) +
                              "\" or \"1 +- 0.5 " + (unit == "1" ? "" : unit) + "\"";
  std::size_t at = text.find("+-");
  const bool about = at != text.npos;
  if (!about) at = text.find("..");
  if (at == text.npos) return {std::nullopt, example};
  const std::string_view left = trimmed(std::string_view(text).substr(0, at)),
                         right = trimmed(std::string_view(text).substr(at + 2));
  const Unit expected = Unit::of(unit);
  const auto a = quantity_of(left, right, expected), b = quantity_of(right, left, expected);
  const bool a_missing = left.empty() && !about, b_missing = right.empty() && !about;
  if ((!a && !a_missing) || (!b && !b_missing) || (a_missing && b_missing))
    return {std::nullopt, example};
  for (const auto* end : {&a, &b})
    if (*end && !(*end)->unit.same_dimension(expected))
      return {std::nullopt, "expected a window in " + (unit == "1" ? "plain numbers" : unit)};
  Window window{a ? a->si : -kInfinity, b ? b->si : kInfinity};
  if (about) {
    const double zero = b->unit.to_si(0.0L);  // offset of degrees Celsius
    window = {a->si - (b->si - zero), a->si + (b->si - zero)};
  }
  if (!(window.from <= window.to)) return {std::nullopt, "expected its lower end first"};
  return {window, ""};
}

std::vector<Stretch> stretches_of(const std::vector<double>& time, std::size_t samples) {
  if (time.size() < 2) return {{0, samples}};
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  std::vector<double> sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual = *middle;
  std::vector<Stretch> stretches = {{0, 1}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (std::abs(steps[i] - usual) <= 0.5 * std::abs(usual)) {
      ++stretches.back().end;
    } else {
      stretches.push_back({i + 1, i + 2});
    }
  }
  return stretches;
}

std::vector<int> directions_of(const std::vector<double>& values,
                               const std::vector<Stretch>& stretches) {
  constexpr double kTurn = 0.05;  // share of the range: more than noise, less than any sweep
  double low = kInfinity, high = -kInfinity;
  for (const double value : values) {
    low = std::min(low, std::isnan(value) ? low : value);
    high = std::max(high, std::isnan(value) ? high : value);
  }
  const double turn = kTurn * (high - low);
  std::vector<int> directions(values.size(), 0);
  for (const Stretch& stretch : stretches) {
    int direction = 0;
    std::size_t least = stretch.first, most = stretch.first;  // since the last turning point
    std::size_t from = stretch.first;                         // last turning point
    const auto settle = [&](std::size_t end, int which) {
      for (std::size_t i = from; i < end; ++i)
        if (!std::isnan(values[i])) directions[i] = which;
    };
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      if (std::isnan(values[i])) continue;
      if (std::isnan(values[least]) || values[i] < values[least]) least = i;
      if (std::isnan(values[most]) || values[i] > values[most]) most = i;
      const bool rises = direction <= 0 && values[i] > values[least] + turn;
      const bool falls = direction >= 0 && values[i] < values[most] - turn;
      if (!rises && !falls) continue;
      const std::size_t corner = rises ? least : most;
      settle(corner, direction);
      from = corner;
      direction = rises ? 1 : -1;
      (rises ? most : least) = i;
    }
    settle(stretch.end, direction);
  }
  return directions;
}

}  // namespace latsch::correlation
