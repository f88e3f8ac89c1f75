// SPDX-License-Identifier: Apache-2.0
// A car: a chassis, rigid or of two halves that twist against each other, and two axles of double
// wishbones on bushings. Axes at rest: x forward, y left, z up, the ground z = 0; left and right
// are mirror images. The springs act through rockers. Alternatively they are locked: then the
// inboard ends of the push-rods are fixed to the chassis, as with rigid bars on a rig.
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

/// Spring, damper, inerter and bump stop that act along one line. The line becomes shorter when the
/// wheel rises.
struct SpringUnit {
  double stiffness = 0.0;  // N/m
  double damping = 0.0;    // N s/m
  double inertance = 0.0;  // kg
  // Further force laws, functions of the unit's extension from rest.
  std::vector<multibody::ForcePart> parts = {};
};

/// The rocker of the left corner and the hardpoints of the parts attached to it, in m.
struct Inboard {
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit length
  Eigen::Vector3d damper = Eigen::Vector3d::Zero(), damper_on_chassis = Eigen::Vector3d::Zero();
  SpringUnit unit;
  double rocker_mass = 0.3;  // kg
  /// Anti-roll bar. Drop links join the rockers to its blades; it acts on the difference of both
  /// sides' travel along these links.
  struct AntiRollBar {
    Eigen::Vector3d link, blade;
    double stiffness = 0.0;  // N/m per difference of the links' travel
  };
  std::optional<AntiRollBar> bar;
  /// Third element of an axle: acts on the sum of the extensions of both sides' spring units.
  std::optional<SpringUnit> heave;
  /// Bearing of the rocker: its stiffness in translation and against tilting. About its axis the
  /// rocker turns freely. If the joint of the push-rod is rigid, the bearing is at least as stiff
  /// as this joint.
  double bearing = 1e8;           // N/m
  double bearing_tilt = 1e5;      // N m/rad
  double bearing_damping = 1e-4;  // s, damping divided by stiffness
};

/// Masses of one side, kg.
struct AxleMasses {
  double upper_wishbone = 0.8, lower_wishbone = 1.0, pushrod = 0.4, trackrod = 0.3;
  double rod_radius = 0.01;          // m
  multibody::BodyMass upright = {};  // center in m, relative to the wheel center
  // Mass of the wheel, kg, including that part of the tire's mass which the tire model does not
  // contain.
  double wheel = 0.0;
  double wheel_spin = 0.0;    // kg m^2 about the spin axis, with the same part of the tire
  double wheel_across = 0.0;  // kg m^2 about an axis at right angles to the spin axis
};

struct Axle {
  suspension::DoubleWishbone corner;  // hardpoints of the left corner
  AxleMasses masses;
  std::optional<Inboard> inboard;  // not set: the springs are locked
  // Spin axis of the wheel relative to the upright's y axis at rest, rad.
  double camber = 0.0, toe = 0.0;
  bool steered = false;  // true: the rack moves the inboard ends of the track-rods along y
};

struct Chassis {
  multibody::BodyMass body;
  /// Torsional spring between the front and rear half of the chassis, about an axis along x through
  /// `x` and the height `z`. Each half has the share of the mass that its axle would carry.
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
  std::optional<AeroMap> aero;  // not set: no aerodynamic forces
  double gravity = 9.80665;     // m/s^2

  /// Returns a message that says what is wrong with the car and names the part, or an empty text.
  std::string fault() const;
};

}  // namespace latsch::car
