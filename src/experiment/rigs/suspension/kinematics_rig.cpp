// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/suspension/kinematics_rig.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace latsch::experiment {
namespace {

using suspension::KinematicAxle;
using suspension::KinematicOutput;
using suspension::Sense;
using suspension::Side;
using Group = KinematicOutput::Group;
using State = KinematicState;

// Straight ahead, (5) of axle_kinematics.h is 0 / 0. Below the first angle it is evaluated at the
// second one, whose result is close to the limit.
constexpr double kStraightAhead = 1e-3, kNearStraightAhead = 1e-2;  // rad

bool is_recorded(const KinematicsTest& test, const KinematicOutput& output) {
  if (output.group == Group::rates) return test.with_rates;
  return output.group != Group::bar || test.with_anti_roll_bar;
}

void add_axle(std::vector<KinematicChannel>& channels) {
  channels.insert(
      channels.end(),
      {{"roll", "rad", [](const State& s) { return s.axle.roll; }, Sense::about_x},
       {"track", "m", [](const State& s) { return s.axle.track; }},
       {"axle_roll_center_height", "m", [](const State& s) { return s.axle.roll_center_height; }},
       {"axle_roll_center_y",
        "m",
        [](const State& s) { return s.axle.roll_center_y; },
        Sense::along_y},
       {"force_roll_center_height",
        "m",
        [](const State& s) { return s.axle.force_roll_center_height; }},
       {"roll_steer",
        "1",
        [](const State& s) { return suspension::roll_steer(s.own, s.axle.track); },
        Sense::about_z,
        Sense::about_x},
       {"roll_camber",
        "1",
        [](const State& s) { return suspension::roll_camber(s.own, s.axle.track); }},
       {"other_travel", "m", [](const State& s) { return s.other_travel; }},
       {"other_toe", "rad", [](const State& s) { return s.other.toe; }},
       {"other_steer", "rad", [](const State& s) { return s.other.steer; }, Sense::about_z},
       {"other_camber", "rad", [](const State& s) { return s.other.camber; }}});
}

void add_anti(const suspension::VehicleData& vehicle, std::vector<KinematicChannel>& channels) {
  const auto braking = [vehicle](const State& s) {
    return suspension::anti_features(s.own, vehicle).braking;
  };
  const auto driving = [vehicle](const State& s) {
    return suspension::anti_features(s.own, vehicle).driving;
  };
  if (vehicle.is_front) {
    channels.push_back({"anti_dive", "1", braking});
    channels.push_back({"anti_lift", "1", driving});
  } else {
    channels.push_back({"anti_lift", "1", braking});
    channels.push_back({"anti_squat", "1", driving});
  }
}

double other_travel(const KinematicsTest& test, double travel) {
  switch (test.mode) {
    case KinematicsTest::Mode::parallel:
      return travel;
    case KinematicsTest::Mode::opposed:
      return -travel;
    case KinematicsTest::Mode::single:
      break;
  }
  return 0.0;
}

/// Moves the axle through the states of a test.
class MovedAxle {
 public:
  MovedAxle(const suspension::CornerGeometry& corner, const KinematicsTest& test)
      : test_(test),
        is_left_(corner.linkage.wheel.side == Side::left),
        axle_(corner, test.at),
        straight_(corner, test.at),
        steered_(corner, test.at) {}

  Result<State> state(double travel, double rack) {
    State s{.travel = travel,
            .other_travel = other_travel(test_, travel),
            .rack = rack,
            .own = {},
            .other = {},
            .axle = {},
            .steer_inner = 0.0,
            .steer_outer = 0.0,
            .ackermann = 0.0};
    const auto wheels = move(axle_, s, rack);
    if (!wheels) return wheels.failure();
    s.own = is_left_ ? wheels->left : wheels->right;
    s.other = is_left_ ? wheels->right : wheels->left;
    s.axle = axle_of(wheels->left, wheels->right, test_.outer_share);
    if (test_.wheelbase)
      if (const Status done = steer(*wheels, s); !done) return done.failure();
    return s;
  }

 private:
  using Wheels = KinematicAxle::Wheels;

  Result<Wheels> move(KinematicAxle& axle, const State& s, double rack) const {
    return axle.move_to(
        is_left_ ? s.travel : s.other_travel, is_left_ ? s.other_travel : s.travel, rack);
  }

  /// Sets the steering angles, which are relative to the middle position of the rack.
  Status steer(const Wheels& wheels, State& s) {
    const auto middle = move(straight_, s, 0.0);
    if (!middle) return middle.failure();
    const auto angles = [&](const Wheels& at) {
      return std::pair(at.left.steer - middle->left.steer, at.right.steer - middle->right.steer);
    };
    const auto [left, right] = angles(wheels);
    const bool turns_left = left + right > 0.0;
    s.steer_inner = turns_left ? left : -right;
    s.steer_outer = turns_left ? right : -left;
    if (std::abs(left + right) > 2.0 * kStraightAhead) {
      s.ackermann = suspension::ackermann(left, right, s.axle.track, *test_.wheelbase);
      return {};
    }
    const double by_rack = 0.5 * (middle->left.steer_by_rack + middle->right.steer_by_rack);
    const auto near = move(steered_, s, kNearStraightAhead / by_rack);
    if (!near) return near.failure();
    const auto [near_left, near_right] = angles(*near);
    s.ackermann = suspension::ackermann(near_left, near_right, s.axle.track, *test_.wheelbase);
    return {};
  }

  const KinematicsTest& test_;
  bool is_left_;
  KinematicAxle axle_, straight_, steered_;
};

}  // namespace

std::vector<KinematicChannel> kinematic_channels(const KinematicsTest& test) {
  std::vector<KinematicChannel> channels = {
      {"travel", "m", [](const State& s) { return s.travel; }},
      {"rack", "m", [](const State& s) { return s.rack; }, Sense::along_y}};
  for (const KinematicOutput& output : suspension::kinematic_outputs())
    if (is_recorded(test, output))
      channels.push_back({output.name,
                          output.unit,
                          [value = output.value](const State& s) { return s.own.*value; },
                          output.of,
                          output.by});
  add_axle(channels);
  if (test.vehicle) add_anti(*test.vehicle, channels);
  if (test.wheelbase) {
    channels.push_back({"steer_inner", "rad", [](const State& s) { return s.steer_inner; }});
    channels.push_back({"steer_outer", "rad", [](const State& s) { return s.steer_outer; }});
    channels.push_back({"ackermann", "1", [](const State& s) { return s.ackermann; }});
  }
  if (test.rack_per_turn) {
    const double turn = 2.0 * std::numbers::pi / *test.rack_per_turn;
    channels.push_back({"steer_ratio", "1", [turn](const State& s) {
                          return turn /
                                 std::abs(0.5 * (s.own.steer_by_rack + s.other.steer_by_rack));
                        }});
  }
  return channels;
}

Result<Channels> run(const suspension::CornerGeometry& corner, const KinematicsTest& test) {
  MovedAxle axle(corner, test);
  const auto recorded = kinematic_channels(test);
  std::vector<std::vector<double>> values(recorded.size());
  for (auto& column : values) column.reserve(test.travel.size());
  for (std::size_t i = 0; i < test.travel.size(); ++i) {
    const auto state = axle.state(test.travel[i], test.rack[i]);
    if (!state)
      return Failure{
          fmt::format("state {} of the kinematic rig: {}", i + 1, state.failure().reason)};
    for (std::size_t k = 0; k < recorded.size(); ++k)
      values[k].push_back(recorded[k].value(*state));
  }
  Channels channels;
  for (std::size_t k = 0; k < recorded.size(); ++k)
    channels.add({recorded[k].name, recorded[k].unit, std::move(values[k])});
  return channels;
}

}  // namespace latsch::experiment
