// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/steady_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "experiment/rigs/fe_rolling/patch_limits.h"
#include "experiment/rigs/fe_rolling/rolling_table.h"
#include "experiment/rigs/slip/slip_states.h"

namespace latsch::experiment {
namespace {

using magic_formula::Angles;

/// Throws InputError for a state with slip on ground without friction.
void check_friction(const formats::CsvTable& table, const RollingTest& test) {
  if (test.friction.value_or(kAssumedFriction) > 0.0) return;
  for (std::size_t k = 0; k < test.rows.size(); ++k) {
    const RollingRow& row = test.rows[k];
    if (row.kappa.value_or(0.0) == 0.0 && row.alpha == 0.0 && row.turn_slip == 0.0) continue;
    throw InputError(table.place(static_cast<int>(k)),
                     "the friction of the test is 0 and this state has a slip: frictionless ground "
                     "carries neither torque nor side force; expected friction above 0, or no "
                     "slips");
  }
}

/// Returns the states in the axes of the side for which the tire is described.
RollingTest rolling_test(const formats::CsvTable& table, const SteadyConditions& conditions) {
  if (const std::string why = refused_conditions(conditions); !why.empty()) throw InputError(why);
  TableReading reading;
  if (values_of(table, "Vx").empty()) reading.speed = kAssumedSpeed;
  reading.takes_turn_slip = conditions.conventions.turn_slip;
  reading.is_free_without_kappa = false;
  RollingTest test;
  test.friction = conditions.friction;
  test.rows = rows_of(table, reading);
  check_friction(table, test);
  if (conditions.conventions.mirrored)
    for (RollingRow& row : test.rows) {
      row.alpha = -row.alpha;
      row.camber = -row.camber;
      row.turn_slip = -row.turn_slip;
    }
  return test;
}

/// Returns the channels of states found. If the tire is mirrored, the states are those of its
/// mirror image.
Channels channels_of(std::span<const RolledState> states, bool is_mirrored) {
  const double side = is_mirrored ? -1.0 : 1.0;
  Channels channels;
  const auto add = [&](const char* name, const char* unit, const auto& value) {
    Channel channel{name, unit, {}};
    for (const RolledState& state : states) channel.values.push_back(value(state));
    channels.add(std::move(channel));
  };
  using State = const RolledState&;
  add("Fx", "N", [](State s) { return s.state.forces.force.x(); });
  add("Fy", "N", [=](State s) { return side * s.state.forces.force.y(); });
  add("Fz", "N", [](State s) { return s.state.forces.force.z(); });
  add("Mx", "N m", [=](State s) { return side * s.state.forces.moment.x(); });
  add("My", "N m", [](State s) { return s.state.forces.moment.y(); });
  add("Mz", "N m", [=](State s) { return side * s.state.forces.moment.z(); });
  add("R_e", "m", [](State s) { return s.effective_radius; });
  add("R_l", "m", [](State s) { return s.state.loaded_radius(); });
  add("length", "m", [](State s) { return patch_of(s.state).length; });
  add("width", "m", [](State s) { return patch_of(s.state).width; });
  add("omega", "rad/s", [](State s) { return s.state.of.spin; });
  return channels;
}

}  // namespace

std::string refused_conditions(const SteadyConditions& conditions) {
  if (conditions.conventions.angles == Angles::direct) return "";
  return "angles = \"tangent\" replaces the angles in the equations of a Magic Formula, and a "
         "finite-element tire has no such equations: it rolls at the angles of the table; expected "
         "angles = \"direct\"";
}

Status roll_table(TireRig& rig,
                  const formats::CsvTable& table,
                  const SteadyConditions& conditions,
                  const std::function<void(const Channels&)>& tell) {
  const RollingTest test = rolling_test(table, conditions);
  // States are found in another order than that of the table.
  std::vector<char> is_known(test.rows.size());
  std::size_t told = 0;
  const auto found =
      roll_states(rig, test, [&](const std::vector<RolledState>& states, std::size_t row) {
        is_known[row] = 1;
        const auto open =
            std::find(is_known.begin() + static_cast<std::ptrdiff_t>(told), is_known.end(), 0);
        const auto known = static_cast<std::size_t>(open - is_known.begin());
        if (known == told) return;
        tell(channels_of(std::span(states).subspan(told, known - told),
                         conditions.conventions.mirrored));
        told = known;
      });
  return found ? Status{} : Status{found.failure()};
}

Result<Channels> roll_table(TireRig& rig,
                            const formats::CsvTable& table,
                            const SteadyConditions& conditions,
                            fe_tire::TireSlopes* slopes) {
  const bool is_mirrored = conditions.conventions.mirrored;
  const auto states = roll_states(rig, rolling_test(table, conditions), {}, slopes);
  if (!states) return states.failure();
  const Channels channels = channels_of(*states, is_mirrored);
  ChannelSlopes known = slopes_of(*states, is_mirrored ? -1.0 : 1.0);
  if (known.empty()) return channels;
  known.emplace_back("R_e", slopes_by(*states, [](const RolledState& rolled, std::size_t k) {
                       return rolled.effective_radius_rates[k];
                     }));
  return with_slopes(channels, known);
}

std::vector<std::string> remarks_on_table(const TireRig& rig,
                                          const formats::CsvTable& table,
                                          const SteadyConditions& conditions) {
  // throws for conditions that the tire does not take
  const RollingTest test = rolling_test(table, conditions);
  std::vector<std::string> remarks;
  magic_formula::Parameters assumed;
  assumed.LONGVL = kAssumedSpeed;
  assumed.INFLPRES = rig.own_pressure();
  for (const std::string& column : slip_states(table, assumed).unused)
    remarks.push_back(fmt::format("{}: column {} is not used", table.file(), in_quotes(column)));
  if (std::string words = assumed_states(table, assumed); !words.empty())
    remarks.push_back(table.file() + ": " + words);
  if (!conditions.friction)
    remarks.push_back(
        friction_in_words(rig, highest_pressure(test, rig.own_pressure()), fastest(test.rows)));
  if (std::string words = words_on_sectors(rig, test); !words.empty())
    remarks.push_back(std::move(words));
  if (!conditions.conventions.limits)
    remarks.emplace_back(
        "limits = \"off\" has no effect: a finite-element tire has no ranges that limit its "
        "states");
  if (rig.losses().is_elastic())
    remarks.emplace_back(
        "Fx and My have no rolling resistance but that of sliding, because no rubber of the tire "
        "has Prony terms or a loss factor");
  return remarks;
}

}  // namespace latsch::experiment
