// SPDX-License-Identifier: Apache-2.0
// The footprint of a finite-element tire that rolls: pressure, shear, sliding speed and grip, on
// the tread's points along their lines and on sensors in the ground.
//
// Grip is the used share of the friction, |t|/(mu p). A point stands for a rectangle of the tread,
// as that of a standing tire does (tire_footprint.h). A sensor reads forces: means over its square.
#pragma once

#include <vector>

#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "models/tire/footprint.h"

namespace latsch::experiment {

/// Sensors in the ground of a footprint.
struct GroundSensors {
  double side = 15e-3;                   // m, of the square
  std::vector<Eigen::Vector2d> at = {};  // m, from the contact center
};

/// A point of the tread in contact, in W.
struct RollingPoint {
  int line = 0;                                         // counted from the right edge, from 0
  double x = 0.0, y = 0.0;                              // m, from the contact center
  double pressure = 0.0, shear_x = 0.0, shear_y = 0.0;  // Pa, on the tire
  double slide_x = 0.0, slide_y = 0.0;                  // m/s, over the ground; 0 if it sticks
  double grip = 0.0;                                    // |t|/(mu p), 0 to 1
  double power = 0.0;                                   // W/m^2, lost by sliding
};

struct RollingFootprint {
  Footprint footprint;               // rectangles, in the order of the points
  std::vector<RollingPoint> points;  // line by line, along each from front to back
};

/// Returns the footprint of a state. Length, width and area are those of the points' rectangles.
RollingFootprint footprint_of(const fe_tire::RollingState& state);

/// Returns the channels of the test, one value for each state: "alpha", "kappa", "gamma", "Vx",
/// "load", "length", "width", "area", "mean_pressure", "peak_pressure", "grip_level", "sticking"
/// (share of the load), "sliding_speed" (m/s, mean weighted by pressure), "loss_friction" (W); for
/// sensors, all of one state and then those of the next: "pressure", "shear_x", "shear_y" (Pa),
/// "slide_x", "slide_y" (m/s, means weighted by pressure), "grip", "sensor_x", "sensor_y" (m).
Channels footprint_channels(const GroundSensors& sensors, const std::vector<RolledState>& states);

}  // namespace latsch::experiment
