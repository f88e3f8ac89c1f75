// SPDX-License-Identifier: Apache-2.0
// One axle of a car on the rig for kinematics and compliance: the chassis is held, loads act on
// both wheels at the contact patch or at the wheel center, pads may raise the wheels to a
// prescribed travel, the rack is where it is told. What couples the wheels is there: anti-roll bar,
// third element, what a rack leaves to them. Springs act, or bars stand in their place. States
// follow each other as friction remembers them.
//
// Slopes in the stiffnesses of bushings are exact (multibody/equilibrium.h, adjoint) as long as no
// bushing has friction and no pad stands below a wheel: a spring's preload is what the car's weight
// makes of all stiffnesses.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/kc_rig.h"
#include "measurement/channels.h"
#include "models/car/car_mechanism.h"

namespace latsch::experiment {

struct AxleKcTest {
  static constexpr std::array<const char*, 2> kSides = {"L", "R"};

  bool front = true;
  bool springs_locked = false;
  bool at_wheel_center = false;
  std::vector<Channel> prescribed;  // as they are stated: recorded beside what moves
  Eigen::Matrix<double, 12, Eigen::Dynamic> loads;  // of left and right wheel, N, N m; by state
  std::optional<std::array<std::vector<double>, 2>> travel;  // m, of the wheel centers, by pads
  std::vector<double> rack;                                  // m, a value a state
  std::optional<SlopesBy> slopes;                            // of what moves, by what is prescribed

  Eigen::Index states() const { return loads.cols(); }
};

/// What moves, without its slopes: dx_L ... caster_L, dx_R ...; Fz of the pads, N; springs, m.
std::vector<std::pair<std::string, std::string>> axle_kc_moved(const AxleKcTest& test);

/// What is prescribed, what moves and its slopes; with the slopes that are asked for, in joints of
/// the car's mechanism.
Result<Channels> run(const car::CarMechanism& car,
                     const AxleKcTest& test,
                     const KcSlopes& asked = {},
                     const RigWatcher& watch = {});

/// 144 channels, dx_L_by_Fx_L ... about_z_R_by_Mz_R, by state: travel and rotation of the upright
/// at the loads' point; and the classical compliances in and out of phase.
Result<Channels> axle_compliance(const car::CarMechanism& car, const AxleKcTest& test);

}  // namespace latsch::experiment
