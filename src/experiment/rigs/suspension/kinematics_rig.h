// SPDX-License-Identifier: Apache-2.0
// The rig for rigid kinematics of an axle: the chassis is held fixed, both wheels are moved up and
// down together, in opposite directions or one alone, and the rack is moved sideways. The other
// wheel is the mirror image of the one in the file. Equations and signs:
// models/suspension/kinematic_outputs.h and axle_kinematics.h.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "measurement/channels.h"
#include "models/suspension/axle_kinematics.h"

namespace latsch::experiment {

struct KinematicsTest {
  enum class Mode { parallel, opposed, single };

  Mode mode = Mode::parallel;
  suspension::TravelOf at = suspension::TravelOf::contact;
  std::vector<double> travel, rack;  // m; equally many of each
  bool with_rates = false, with_anti_roll_bar = false;
  /// Share of the lateral force that the outer wheel carries, for the force-based roll center.
  double outer_share = 0.5;
  /// Data of the vehicle for anti-dive and the other shares of the load transfer.
  std::optional<suspension::VehicleData> vehicle;
  std::optional<double> wheelbase;      // m; for Ackermann
  std::optional<double> rack_per_turn;  // m per turn of the steering wheel
};

/// The axle in one state of the test; `own` is the wheel of the file.
struct KinematicState {
  double travel, other_travel, rack;
  suspension::WheelKinematics own, other;
  suspension::AxleKinematics axle;
  double steer_inner, steer_outer, ackermann;  // set if the test has a wheelbase
};

struct KinematicChannel {
  std::string name, unit;
  std::function<double(const KinematicState&)> value;
  suspension::Sense of = suspension::Sense::same, by = suspension::Sense::same;  // sign_views.h
};
/// Returns the names of the channels that a test records, in the order in which they are recorded.
std::vector<KinematicChannel> kinematic_channels(const KinematicsTest& test);

Result<Channels> run(const suspension::CornerGeometry& corner, const KinematicsTest& test);

}  // namespace latsch::experiment
