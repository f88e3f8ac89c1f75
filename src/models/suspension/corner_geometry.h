// SPDX-License-Identifier: Apache-2.0
// What a corner's kinematics depend on: its linkage, how its spring follows the wheel, and the
// rates of spring and tire where they are known.
#pragma once

#include <optional>
#include <string>

#include "models/suspension/linkage.h"
#include "models/suspension/spring_drive.h"

namespace latsch::suspension {

struct CornerGeometry {
  Linkage linkage;
  SpringDrive spring;
  /// Ball joints at rest, m; none: the upright is steered about the axis of its instantaneous
  /// rotation by the rack, its spring held (five links).
  struct Kingpin {
    Eigen::Vector3d lower, upper;
  };
  std::optional<Kingpin> kingpin;
  struct Rates {
    double spring;       // N/m
    double sprung_mass;  // kg, that the spring of this corner carries at rest
    double tire;         // N/m, vertical
  };
  std::optional<Rates> rates;

  /// What is wrong with it, naming the part, or empty.
  std::string fault() const;
};

}  // namespace latsch::suspension
