// SPDX-License-Identifier: Apache-2.0
// Reads a car from its file, which names the files of its suspensions and tires
// (base/document_parts.h).
//
//   kind = "car"
//   title = "Student race car"
//   front_suspension = "front.toml"      # kind = "suspension", a left one; the right is its mirror
//   rear_suspension = "rear.toml"        # image
//   front_tire = "tire.toml"             # any tire that rolls, or [front.spring_tire] below. A
//   rear_tire = "tire.toml"              # tire of the left side by its file (TYRESIDE of a .tir,
//                                        # side of a ring; left if not given) is mirrored on the
//                                        # right, and vice versa
//   front_tire_right = "right.tir"       # file of a right tire that is no mirror image
//   front_tire_kind = "magic_formula"    # model for a .tir: this one by default; or "rigid_ring"
//   [chassis]                            # all that is sprung
//   mass = "180 kg"
//   center = ["0.75 m", "0 m", "0.28 m"]
//   inertia = ["25 kg m^2", "90 kg m^2", "100 kg m^2"]    # about the center: xx, yy, zz
//   inertia_xz = "0 kg m^2"              # ∫ x z dm
//   torsion = "4 kN m/deg"               # between front and rear half; rigid unless given
//   torsion_damping = "0 N m s/deg"
//   torsion_at = ["0.75 m", "0.28 m"]    # x and z of the axis
//   [front]                              # and [rear]
//   locked = false                       # true: bars replace the springs
//   camber = "-1 deg"                    # of the wheel at rest; toe; default 0
//   [front.mass]
//   upper_wishbone = "0.8 kg"            # lower_wishbone, pushrod, trackrod, rocker: thin rods
//   upright = "4 kg"                     # with all parts that do not turn with the wheel
//   wheel = "8 kg"                       # with rim, and the tire's mass missing in its model
//   [front.inertia]
//   upright = ["0.03 kg m^2", "0.03 kg m^2", "0.02 kg m^2"]    # xx, yy, zz about its center
//   wheel_spin = "0.25 kg m^2"
//   wheel_across = "0.14 kg m^2"
//   [front.spring]                       # between rocker_damper and damper_chassis of the
//   stiffness = "52 N/mm"                # suspension's hardpoints
//   damping = "2.5 kN s/m"               # or damper = [["-1 m/s", "-3 kN"], ...]: force over the
//   inertance = "0 kg"                   # rate of extension, pull positive
//   curve = [["-30 mm", "-2 kN"], ...]   # added to stiffness, over extension from rest: a bump
//                                        # stop, a progressive spring
//   [front.third]                        # on the sum of both sides: keys as of [front.spring]
//   [front.anti_roll_bar]                # between rocker_arb_link and arb_link_blade
//   stiffness = "80 N/mm"                # per difference of the links' travels
//   [aero]                               # without this table there is no air
//   area = "1.2 m^2"
//   density = "1.2 kg/m^3"
//   floor = ["30 mm", "40 mm"]           # height of the floor at the axles in the car as drawn
//   map = [["20 mm", "30 mm", 1.4, 1.7], ...]   # front and rear height of the floor, coefficients
//                                        # of downforce at the axles; one row: constant
//   drag = 0.9
//   drag_height = "0.3 m"
//   [driver]
//   line = "0 mm"                        # to the left of the given line
//   drives = "rear"                      # the axle that pulls against drag and rolling losses:
//                                        # default; or "front", "both" (half each)
//   [front.spring_tire]                  # replaces front_tire: a vertical spring
//   radius = "235 mm"
//   stiffness = "117 N/mm"
//   damping = "300 N s/m"
#pragma once

#include <array>

#include "base/document.h"
#include "models/car/car_parameters.h"
#include "models/car/spring_tire.h"

namespace latsch::car {

/// A car as described in its file, without its tires.
struct CarFile {
  CarParameters parameters;  // suspensions, masses, springs and air
  /// Parameters of the spring tires; set for an axle whose file names no tire.
  std::optional<SpringTireParameters> front_spring_tire, rear_spring_tire;
  double driver_line = 0.0;  // m
  /// Shares of the front and the rear axle in the longitudinal pull.
  std::array<double, 2> drives = {0.0, 1.0};
};

/// Reads the car with its suspensions, but without its tires: the tables front_tire and rear_tire
/// are read by the code for the respective kind of tire. Throws InputError.
CarFile read_car(const Node& root);

}  // namespace latsch::car
