// SPDX-License-Identifier: Apache-2.0
// What the virtual rig is told to do with a tire: the prescribed inputs of one test.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "models/fe_tire/ring/fe_tire.h"

namespace latsch::experiment {

/// Vertical force over deflection: the tire stands still and is pressed on flat ground. The
/// abscissa is either the deflection from first touch or the loaded radius (wheel center to
/// ground); the other list is empty.
struct LoadDeflection {
  double pressure = 0.0;  // Pa
  fe_tire::Ground ground = {};
  std::vector<double> deflections = {};   // m
  std::vector<double> loaded_radii = {};  // m
};

/// Vibration modes with the rim clamped, of the unloaded tire or standing on the ground.
struct ModalTest {
  double pressure = 0.0;  // Pa
  fe_tire::Ground ground;
  std::optional<double>
      deflection;              // m from first touch; with neither of the two the tire hangs free
  std::optional<double> load;  // N; the rig finds the deflection
  int count = 20;              // lowest modes
  Eigen::Matrix3Xd
      points;  // m, wheel frame, undeformed: where shapes are recorded; none: no shapes

  bool loaded() const { return deflection || load; }
};

struct LoadCase {
  std::string name;  // of the experiment; failures carry it
  std::variant<LoadDeflection, ModalTest> test;
};

}  // namespace latsch::experiment
