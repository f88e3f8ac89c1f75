// SPDX-License-Identifier: Apache-2.0
// The rig for kinematics and compliance (K&C) of a suspension corner. The chassis and the inboard
// end of the push-rod are held fixed, and loads of fixed direction act at the contact patch or at
// the wheel's center. Axes of the ground, ISO 8855: x forward, y left, z up. Travel and angles are
// relative to the unloaded corner; signs as in models/suspension/wheel_position.h.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/rig_slopes.h"
#include "measurement/channels.h"
#include "models/multibody/equilibrium.h"
#include "models/suspension/compliant_corner.h"

namespace latsch::experiment {

struct KcTest {
  static constexpr std::array<const char*, 6> kLoads = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  static constexpr std::array<const char*, 6> kMoved = {
      "dx", "dy", "dz", "camber", "toe", "caster"};

  bool at_wheel_center = false;
  Eigen::Matrix<double, 6, Eigen::Dynamic> loads;  // N, N m; one column for each state
  std::array<bool, 6> stated = {};                 // loads that are recorded
  /// slopes of the motion by one of the stated loads
  std::optional<SlopesBy> slopes = {};
};

/// Stiffnesses that depend on a varied parameter, by joint and axis.
using Stiffnesses = std::vector<std::pair<int, int>>;

/// Requested slopes of these channels in varied numbers.
struct KcSlopes {
  std::vector<Stiffnesses> varied;
  std::vector<std::string> channels;
};

/// A state of a rig: the mechanism, its equilibrium, the loads on it.
struct RigState {
  struct Wheel {
    std::string name;                 // "left"; empty if there is only one
    int upright;                      // body
    Eigen::Vector3d center, contact;  // at rest, m
  };
  const multibody::Mechanism& mechanism;
  const multibody::Assembly& assembly;
  const multibody::Rest& rest;
  std::span<const multibody::Load> loads;  // one for each wheel
  std::span<const Wheel> wheels;
  Eigen::Index state;
};
/// The rig calls its watcher for every state.
using RigWatcher = std::function<void(const RigState&)>;

/// Records the stated loads, the motion and its slopes, with the requested slopes in varied
/// numbers.
Result<Channels> run(const suspension::CompliantCorner& corner,
                     const KcTest& test,
                     const KcSlopes& asked = {},
                     const RigWatcher& watch = {});

}  // namespace latsch::experiment
