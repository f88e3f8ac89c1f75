// SPDX-License-Identifier: Apache-2.0
// One axle of a car on the rig for kinematics and compliance: the chassis is held, loads act on
// both wheels at the contact patch or at the wheel center, pads may raise the wheels to a
// prescribed travel, the rack is where it is told. What couples the wheels is there: anti-roll bar,
// third element, what a rack leaves to them. Springs act, or bars stand in their place.
//
// Loads and travels of the right wheel: parallel, the same (of Fy, Mx and Mz the mirror image);
// opposed, the opposite of that; single: none, and the pad holds it where it was.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "measurement/channels.h"
#include "models/car/car.h"

namespace latsch::experiment {

struct AxleKcTest {
  enum class Mode { parallel, opposed, single };
  static constexpr std::array<const char*, 6> kLoads = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};

  bool front = true;
  Mode mode = Mode::parallel;
  bool springs_locked = false;
  bool at_wheel_center = false;
  Eigen::Matrix<double, 6, Eigen::Dynamic> loads;  // of the left wheel, N, N m; a state a column
  std::array<bool, 6> stated = {};
  std::optional<std::vector<double>> travel;  // m, of the left wheel center, by a pad
  std::vector<double> rack;                   // m, a value a state

  Eigen::Index states() const { return loads.cols(); }
};

/// Of left and right: dx_L ... caster_L, dx_R ...; Fz of the pads, N; springs, m.
std::vector<std::pair<std::string, std::string>> axle_kc_channels(const AxleKcTest& test);

Result<Channels> run(const car::Car& car, const AxleKcTest& test);

/// 144 channels, dx_L_by_Fx_L ... about_z_R_by_Mz_R, by state: travel and rotation of the upright
/// at the loads' point; and the classical compliances in and out of phase.
Result<Channels> axle_compliance(const car::Car& car, const AxleKcTest& test);

}  // namespace latsch::experiment
