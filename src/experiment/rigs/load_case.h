// SPDX-License-Identifier: Apache-2.0
// Load cases of a rig with a standing tire, as numbers.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "experiment/rigs/fe_tire/spin_speed.h"
#include "experiment/rigs/inflation.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/motion/rim_motion.h"

namespace latsch::experiment {

/// Vertical force over deflection: the tire stands still and is pressed on flat ground. The
/// abscissa is either the deflection from first touch or the loaded radius (wheel center to
/// ground); the other list is empty.
struct LoadDeflection {
  Inflation pressure = {};
  fe_tire::Ground ground = {};
  std::vector<double> deflections = {};   // m
  std::vector<double> loaded_radii = {};  // m
};

/// Vibration modes with the rim fixed, off the ground or standing on it; off the ground also of a
/// tire that spins and with a rim that moves.
struct ModalTest {
  Inflation pressure = {};
  fe_tire::Ground ground = {};
  /// Deflection from first contact, m. If neither deflection nor load is given, the tire does not
  /// touch the ground.
  std::optional<double> deflection = {};
  std::optional<double> load = {};  // N; the rig finds the deflection
  double camber = 0.0;              // rad, about x, top to the right
  int count = 10;                   // number of lowest modes
  /// Points in the wheel frame on the undeformed tire, m, at which shapes are recorded; none: no
  /// shapes.
  Eigen::Matrix3Xd points = {};

  std::optional<SpinSpeed> speed = {};  // none: at rest
  fe_tire::RimMotion rim = fe_tire::RimMotion::held;
  bool standing_wave = false;  // true: the standing-wave speed is computed, too
  /// true: modes of a finite-element tire with the losses and the dynamic moduli of its file
  bool is_damped = false;

  bool loaded() const { return deflection || load; }
  /// True if the tire spins, its rim moves or its standing-wave speed is asked for.
  bool moves() const { return speed || rim != fe_tire::RimMotion::held || standing_wave; }
};

}  // namespace latsch::experiment
