// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/rolling_chain_rig.h"

#include <algorithm>
#include <map>
#include <memory>
#include <numbers>

#include "models/fe_tire/rolling/rolling_chain.h"

namespace latsch::experiment {
namespace {

using fe_tire::ChainPoint;

/// A number of a point, and its channel.
struct ChainNumber {
  const char *name, *unit;
  double (*of)(const ChainPoint&);
};

constexpr ChainNumber kNumbers[] = {
    {"theta", "rad", [](const ChainPoint& at) { return at.theta; }},
    {"x", "m", [](const ChainPoint& at) { return at.x.x(); }},
    {"y", "m", [](const ChainPoint& at) { return at.x.y(); }},
    {"z", "m", [](const ChainPoint& at) { return at.x.z(); }},
    {"u_x", "m", [](const ChainPoint& at) { return at.u.x(); }},
    {"u_y", "m", [](const ChainPoint& at) { return at.u.y(); }},
    {"u_z", "m", [](const ChainPoint& at) { return at.u.z(); }},
    {"v_x", "m/s", [](const ChainPoint& at) { return at.v.x(); }},
    {"v_y", "m/s", [](const ChainPoint& at) { return at.v.y(); }},
    {"v_z", "m/s", [](const ChainPoint& at) { return at.v.z(); }},
    {"a_x", "m/s^2", [](const ChainPoint& at) { return at.a.x(); }},
    {"a_y", "m/s^2", [](const ChainPoint& at) { return at.a.y(); }},
    {"a_z", "m/s^2", [](const ChainPoint& at) { return at.a.z(); }},
    {"E_rr", "1", [](const ChainPoint& at) { return at.E[0]; }},
    {"E_tt", "1", [](const ChainPoint& at) { return at.E[1]; }},
    {"E_yy", "1", [](const ChainPoint& at) { return at.E[2]; }},
    {"G_rt", "1", [](const ChainPoint& at) { return at.E[3]; }},
    {"G_ty", "1", [](const ChainPoint& at) { return at.E[4]; }},
    {"G_ry", "1", [](const ChainPoint& at) { return at.E[5]; }},
    {"S_rr", "Pa", [](const ChainPoint& at) { return at.S[0]; }},
    {"S_tt", "Pa", [](const ChainPoint& at) { return at.S[1]; }},
    {"S_yy", "Pa", [](const ChainPoint& at) { return at.S[2]; }},
    {"S_rt", "Pa", [](const ChainPoint& at) { return at.S[3]; }},
    {"S_ty", "Pa", [](const ChainPoint& at) { return at.S[4]; }},
    {"S_ry", "Pa", [](const ChainPoint& at) { return at.S[5]; }},
    {"cord_strain", "1", [](const ChainPoint& at) { return at.cord_strain; }},
    {"cord_stress", "Pa", [](const ChainPoint& at) { return at.cord_stress; }},
    {"cord_force", "N/m", [](const ChainPoint& at) { return at.cord_force; }},
    {"energy", "J/m^3", [](const ChainPoint& at) { return at.energy; }},
    {"dissipation", "W/m^3", [](const ChainPoint& at) { return at.dissipation; }},
};

/// A chain with its state, from 1, and its position.
struct MeasuredChain {
  double state, position;
  std::vector<ChainPoint> points;
};

Channels channels_of_chains(const std::vector<MeasuredChain>& all) {
  Channels channels;
  const auto add = [&](const char* name, const char* unit, const auto& value) {
    std::vector<double> values;
    for (const MeasuredChain& one : all)
      for (const ChainPoint& point : one.points) values.push_back(value(one, point));
    channels.add({name, unit, std::move(values)});
  };
  add("state", "1", [](const MeasuredChain& one, const ChainPoint&) { return one.state; });
  add("position", "1", [](const MeasuredChain& one, const ChainPoint&) { return one.position; });
  for (const ChainNumber& number : kNumbers)
    add(number.name, number.unit, [&](const MeasuredChain&, const ChainPoint& point) {
      return number.of(point);
    });
  return channels;
}

/// Orders the points by theta from -pi to pi.
void begin_behind(std::vector<ChainPoint>& points) {
  for (ChainPoint& point : points)
    if (point.theta > std::numbers::pi) point.theta -= 2.0 * std::numbers::pi;
  std::ranges::sort(points, {}, &ChainPoint::theta);
}

}  // namespace

Channels no_chains() { return channels_of_chains({}); }

namespace {

/// Returns the places in the tire's section, or a Failure that names one that does not exist.
Result<std::vector<fe_tire::ChainPlace>> found_places(const TireRig& rig,
                                                      const ChainPlaces& places) {
  std::vector<fe_tire::ChainPlace> found;
  for (const double position : places.positions) {
    const auto place = fe_tire::find_place(rig.tire().mesh(), rig.losses(), position, places.depth);
    if (!place) return place.failure();
    found.push_back(*place);
  }
  return found;
}

}  // namespace

Result<Channels> chains(TireRig& rig, const RollingTest& test, const ChainPlaces& places) {
  // A place that does not exist is reported before any state is computed.
  if (const auto found = found_places(rig, places); !found) return found.failure();
  const auto states = roll_states(rig, test);
  if (!states) return states.failure();
  return chains_of(rig, *states, places);
}

Result<Channels> chains_of(TireRig& rig,
                           const std::vector<RolledState>& states,
                           const ChainPlaces& places) {
  const auto found = found_places(rig, places);
  if (!found) return found.failure();
  std::map<double, std::unique_ptr<fe_tire::LossMeter>> meters;  // one for each pressure
  std::vector<MeasuredChain> all;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const fe_tire::RollingState& state = states[k].state;
    auto& meter = meters[state.pressure];
    if (!meter) {
      const auto& inflated = rig.inflated(state.pressure);
      if (!inflated) return inflated.failure();
      meter = std::make_unique<fe_tire::LossMeter>(rig.tire(), rig.losses(), *inflated);
    }
    for (std::size_t i = 0; i < found->size(); ++i) {
      auto points = fe_tire::chain(*meter, (*found)[i], state.u, state.alpha, state.of.spin);
      begin_behind(points);
      all.push_back({static_cast<double>(k + 1), places.positions[i], std::move(points)});
    }
  }
  return channels_of_chains(all);
}

}  // namespace latsch::experiment
