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
  /// Ball joints at rest, m. None: the upright is steered by the rack about the axis of its
  /// instantaneous rotation, with its spring held (five links).
  struct Kingpin {
    Eigen::Vector3d lower, upper;
  };
  std::optional<Kingpin> kingpin;
  struct Rates {
    double spring;       // N/m
    double sprung_mass;  // kg, carried by the spring of this corner at rest
    double tire;         // N/m, vertical
  };
  std::optional<Rates> rates;

  /// Returns what is wrong with the geometry, naming the part, or an empty text.
  std::string fault() const;
};

}  // namespace latsch::suspension
