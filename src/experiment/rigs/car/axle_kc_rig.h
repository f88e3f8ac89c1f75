// SPDX-License-Identifier: Apache-2.0
// One axle of a car on the rig for kinematics and compliance (K&C). The chassis is held, loads act
// on both wheels at the contact patch or at the wheel center, pads may raise the wheels to a
// prescribed travel, and the rack is at a prescribed position. Couplings of the wheels are
// included: anti-roll bar, third element, and the rack's compliance. The car's springs act, or
// rigid bars replace them. The states are computed in their order, because friction depends on
// earlier states.
//
// Derivatives by the stiffnesses of bushings are exact (multibody/equilibrium.h, adjoint) if no
// bushing has friction and no pad is below a wheel; with pads, a spring's preload under the car's
// weight would depend on all stiffnesses.
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
  std::vector<Channel> prescribed;  // stated loads and positions, recorded beside the motion
  /// loads on the left and right wheel, N and N m; one column for each state
  Eigen::Matrix<double, 12, Eigen::Dynamic> loads;
  /// displacements of the wheel centers, m, that pads impose
  std::optional<std::array<std::vector<double>, 2>> travel;
  std::vector<double> rack;  // m, one value for each state
  /// Regression of slopes of the motion by a stated quantity; nullopt: no slopes.
  std::optional<SlopesBy> slopes;

  Eigen::Index states() const { return loads.cols(); }
};

/// Returns names and units of the motion without its slopes: dx_L ... caster_L, dx_R ...; Fz of the
/// pads, N; springs, m.
std::vector<std::pair<std::string, std::string>> axle_kc_moved(const AxleKcTest& test);

/// Returns the prescribed channels, the motion and its slopes, and the requested derivatives by the
/// joints of the car's mechanism.
Result<Channels> run(const car::CarMechanism& car,
                     const AxleKcTest& test,
                     const KcSlopes& asked = {},
                     const RigWatcher& watch = {});

/// Returns 144 channels, dx_L_by_Fx_L ... about_z_R_by_Mz_R, by state: travel and rotation of the
/// upright at the point of the loads; and the classical compliances in and out of phase.
Result<Channels> axle_compliance(const car::CarMechanism& car, const AxleKcTest& test);

}  // namespace latsch::experiment
