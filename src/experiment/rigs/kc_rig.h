// SPDX-License-Identifier: Apache-2.0
// The rig for kinematics and compliance of a corner: the chassis is held, the inboard end of the
// push-rod too, and loads of fixed direction act at the contact patch or at the wheel's center.
// Axes of the ground, ISO 8855: x forward, y left, z up. Travel and angles are those from the
// unloaded corner; signs as in models/suspension/wheel_position.h.
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
  Eigen::Matrix<double, 6, Eigen::Dynamic> loads;  // N, N m; a state a column
  std::array<bool, 6> stated = {};                 // which of the loads are recorded
  std::optional<SlopesBy> slopes = {};             // of what moves, by a load that is stated
};

/// Of the stiffnesses, joint and axis, that a number varied stands for.
using Stiffnesses = std::vector<std::pair<int, int>>;

/// Slopes in numbers that are varied, of these channels.
struct KcSlopes {
  std::vector<Stiffnesses> varied;
  std::vector<std::string> channels;
};

/// A state of a rig: what stands on it, where it rests, what acts on it.
struct RigState {
  struct Wheel {
    std::string name;                 // "left"; empty: there is one
    int upright;                      // body
    Eigen::Vector3d center, contact;  // at rest, m
  };
  const multibody::Mechanism& mechanism;
  const multibody::Assembly& assembly;
  const multibody::Rest& rest;
  std::span<const multibody::Load> loads;  // one a wheel
  std::span<const Wheel> wheels;
  Eigen::Index state;
};
/// Looks at every state.
using RigWatcher = std::function<void(const RigState&)>;

/// The loads that are stated, what moves and its slopes; with the slopes that are asked for.
Result<Channels> run(const suspension::CompliantCorner& corner,
                     const KcTest& test,
                     const KcSlopes& asked = {},
                     const RigWatcher& watch = {});

}  // namespace latsch::experiment
