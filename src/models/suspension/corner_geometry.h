// SPDX-License-Identifier: Apache-2.0
// Data that determine a corner's kinematics: its linkage, the drive of its spring, and the rates of
// spring and tire if they are known.
#pragma once

#include <optional>
#include <string>

#include "models/suspension/linkage.h"
#include "models/suspension/spring_drive.h"

namespace latsch::suspension {

struct CornerGeometry {
  Linkage linkage;
  SpringDrive spring;
  /// Ball joints of the kingpin at rest, m. A five-link corner has none: the rack steers its
  /// upright about the instantaneous axis of rotation with the spring held.
  struct Kingpin {
    Eigen::Vector3d lower, upper;
  };
  std::optional<Kingpin> kingpin;
  struct Rates {
    double spring;       // N/m
    double sprung_mass;  // kg, mass that the spring of this corner carries at rest
    double tire;         // N/m, vertical
  };
  std::optional<Rates> rates;

  /// Returns an empty text for a valid geometry, otherwise a message that names the part with the
  /// fault.
  std::string fault() const;
};

}  // namespace latsch::suspension
