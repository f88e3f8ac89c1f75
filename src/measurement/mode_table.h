// SPDX-License-Identifier: Apache-2.0
// Measured vibration modes: frequencies, and the labels and shapes that the laboratory determined.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "measurement/measurement_fault.h"

namespace latsch {

struct MeasuredMode {
  double frequency = 0.0;  // Hz
  std::optional<int> n;    // circumferential number: waves around the tire
  std::string type;        // "torsional", "lateral", "radial"; empty: not known
  char phase = ' ';        // 's' or 'a': symmetric or antisymmetric to the contact; ' ': not known
  /// Displacements x y z of sensor point 0, x y z of point 1 ..., in any scale. Empty: no shape was
  /// measured.
  std::vector<double> shape;

  bool operator==(const MeasuredMode&) const = default;
};

struct ModeTable {
  std::vector<MeasuredMode> modes;
  std::vector<std::array<double, 3>> points;  // m, sensors on the undeformed tire, wheel frame

  bool operator==(const ModeTable&) const = default;
};

/// Returns the first fault: no mode, a frequency that is not positive, a negative n, an unknown
/// phase, or shapes that do not fit the sensor points, are not finite or are zero everywhere.
std::optional<MeasurementFault> find_fault(const ModeTable& table);

}  // namespace latsch
