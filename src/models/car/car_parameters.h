// SPDX-License-Identifier: Apache-2.0
// A car: a chassis, rigid or of two halves that twist against each other, and two axles of double
// wishbones on bushings. Axes at rest: x forward, y left, z up, the ground z = 0; left and right
// are mirror images. The springs act by rockers, or are locked: the chassis then holds the inboard
// ends of the push-rods, as with rigid bars on a rig.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "models/car/aero_map.h"
#include "models/multibody/force_part.h"
#include "models/multibody/mechanism.h"
#include "models/multibody/rod_masses.h"
#include "models/suspension/double_wishbone.h"

namespace latsch::car {

/// Spring, damper, inerter and bump stop in one line, which shortens in bump.
struct SpringUnit {
  double stiffness = 0.0;                        // N/m
  double damping = 0.0;                          // N s/m
  double inertance = 0.0;                        // kg
  std::vector<multibody::ForcePart> parts = {};  // functions of its extension from rest
};

/// The rocker of the left corner and the parts on it. Points in m.
struct Inboard {
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit length
  Eigen::Vector3d damper = Eigen::Vector3d::Zero(), damper_on_chassis = Eigen::Vector3d::Zero();
  SpringUnit unit;
  double rocker_mass = 0.3;  // kg
  /// Anti-roll bar, on the difference of both sides' travel along the links from here to its
  /// blades.
  struct AntiRollBar {
    Eigen::Vector3d link, blade;
    double stiffness = 0.0;  // N/m of that difference
  };
  std::optional<AntiRollBar> bar;
  /// Third element, on the sum of both sides' extensions.
  std::optional<SpringUnit> heave;
  /// Bearing of the rocker: stiffness across and against tilting. About its axis the rocker turns
  /// freely. If the joint of the push-rod is rigid, the bearing is at least as stiff.
  double bearing = 1e8;           // N/m
  double bearing_tilt = 1e5;      // N m/rad
  double bearing_damping = 1e-4;  // s, times stiffness gives the damping
};

/// Masses of one side, kg.
struct AxleMasses {
  double upper_wishbone = 0.8, lower_wishbone = 1.0, pushrod = 0.4, trackrod = 0.3;
  double rod_radius = 0.01;          // m
  multibody::BodyMass upright = {};  // m, its center relative to the wheel center
  double wheel = 0.0;                // kg, with the mass of the tire that its model lacks
  double wheel_spin = 0.0;           // kg m^2 about the spin axis, likewise
  double wheel_across = 0.0;         // kg m^2 about an axis across it
};

struct Axle {
  suspension::DoubleWishbone corner;  // left corner
  AxleMasses masses;
  std::optional<Inboard> inboard;  // none: springs are locked
  double camber = 0.0, toe = 0.0;  // rad, wheel axis relative to the upright's y at rest
  bool steered = false;            // the rack moves its track-rods' inboard ends along y
};

struct Chassis {
  multibody::BodyMass body;
  /// Torsion between its halves, about an axis along x at `x` and height `z`. Each half takes the
  /// share of the mass that its axle would carry.
  struct Torsion {
    double stiffness;  // N m/rad
    double damping;    // N m s/rad
    double x, z;       // m
  };
  std::optional<Torsion> torsion;
};

struct CarParameters {
  Chassis chassis;
  Axle front, rear;
  std::optional<AeroMap> aero;  // none: no air
  double gravity = 9.80665;     // m/s^2

  /// Returns what is wrong with the car, naming the part, or an empty text.
  std::string fault() const;
};

}  // namespace latsch::car
