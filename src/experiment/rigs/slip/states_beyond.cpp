// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/states_beyond.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiment/rigs/slip/slip_states.h"
#include "models/magic_formula/limits/file_ranges.h"
#include "models/magic_formula/vertical/load_curve.h"

namespace latsch {

using magic_formula::Parameters;
using magic_formula::State;

namespace {

/// Returns ": Fz above FZMAX = 900 N in 800, up to 2053 N; ..." for every end that states leave.
std::string ends_in_words(const std::vector<StatesBeyond::BeyondEnd>& ends,
                          const Parameters& tire) {
  std::string text;
  const auto ranges = magic_formula::file_ranges();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].count == 0) continue;
    const magic_formula::FileRange& range = ranges[i];
    text += fmt::format("{}{} {} {} = {:.4g}{} in {}, {} to {:.4g}{}",
                        text.empty() ? ": " : "; ",
                        range.what,
                        range.is_upper ? "above" : "below",
                        range.key,
                        range.scale * tire.*range.end,
                        range.unit,
                        ends[i].count,
                        range.is_upper ? "up" : "down",
                        range.scale * ends[i].farthest,
                        range.unit);
  }
  return text;
}

}  // namespace

void StatesBeyond::add(const std::vector<State>& states, const Parameters& tire) {
  count += std::ssize(states);
  const long outside_here = outside_of_ranges(states, tire);
  outside += outside_here;
  const auto ranges = magic_formula::file_ranges();
  ends.resize(ranges.size());
  for (std::size_t i = 0; outside_here > 0 && i < ranges.size(); ++i)
    for (const State& state : states) {
      if (!ranges[i].is_left_by(state, tire)) continue;
      const double value = ranges[i].value(state);
      BeyondEnd& end = ends[i];
      if (end.count++ == 0 || (ranges[i].is_upper ? value > end.farthest : value < end.farthest))
        end.farthest = value;
    }
  unloaded += std::ranges::count_if(states, [](const State& state) { return state.Fz <= 0.0; });
  if (magic_formula::has_load_curve(tire))
    beyond_curve += std::count_if(states.begin(), states.end(), [&](const State& state) {
      return state.Fz > tire.curve_force.back();
    });
}

std::vector<std::string> StatesBeyond::sentences(const Parameters& tire,
                                                 bool limits,
                                                 bool may_be_off) const {
  std::vector<std::string> all;
  if (unloaded > 0)
    all.push_back(
        fmt::format("{} of {} states have a load of 0 or less: the tire is taken to be off the "
                    "road there, without forces; slip, slip angle and turn slip mean nothing",
                    unloaded,
                    count));
  if (limits && outside > 0)
    all.push_back(
        fmt::format("{} of {} states lie outside of the ranges of the tire's file and are limited "
                    "to them{}{}",
                    outside,
                    count,
                    may_be_off ? " (limits = \"off\" uses them unchanged)" : "",
                    ends_in_words(ends, tire)));
  if (beyond_curve > 0)
    all.push_back(
        fmt::format("{} of {} states have a load beyond the last point of [DEFLECTION_LOAD_CURVE], "
                    "{:.4g} N at {:.4g} mm: the last line of the curve is continued",
                    beyond_curve,
                    count,
                    tire.curve_force.back(),
                    1e3 * tire.curve_deflection.back()));
  return all;
}

}  // namespace latsch
