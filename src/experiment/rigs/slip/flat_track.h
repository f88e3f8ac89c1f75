// SPDX-License-Identifier: Apache-2.0
// Virtual flat-track machine: the belt runs below a stationary wheel that is steered or braked from
// one end of a range of slip to the other. For any tire.
//
// As on the machine the axle follows the load: it rises if the tire's force exceeds `load`,
//   z' = (Fz - load)/c,   c = 20 ms load/deflection,
// so that Fz returns to the load within some 20 ms; or the axle is held at the height at which the
// stationary tire carries the load. Free wheel and axle are solved with the tire's step
// (free_wheel.h).
//
// The wheel rolls freely for `run_in`, and farther until its longitudinal force varies no more than
// the tire itself makes it vary; the channel "time" does not count the way beyond.
//
// Channels: "time", "alpha" (rad, angle from the wheel's heading to its velocity, tan α = v_y/v_x
// in C with the sign of NOTATION.md's axes), "kappa" (ω R_e/V - 1, R_e from free rolling before the
// sweep), "Fx" .. "Mz" in the frame of the sweep (hub_frame.h), "loaded_radius" (m, from the wheel
// center down the wheel plane to the belt).
#pragma once

#include "base/result.h"
#include "experiment/rigs/hub_frame.h"
#include "experiment/rigs/inflation.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

/// The quantity that the rig keeps constant: the load, by moving the axle, or the height of the
/// axle.
enum class AxleHold { load, height };

struct SlipSweep {
  double speed = 10.0;   // m/s, of the belt
  double load = 4000.0;  // N
  AxleHold axle = AxleHold::load;
  std::vector<AxisFrame> frames = {AxisFrame::W};  // frames of the forces
  double camber = 0.0;                             // rad
  double alpha_from = 0.0, alpha_to = 0.0;         // rad
  double kappa_from = 0.0, kappa_to = 0.0;
  double run_in = 0.3;    // s, at least, of free rolling, then of the transition to the first slip
  double duration = 1.0;  // s, duration of the sweep
  double step = 5e-4;     // s
  // Forces that have to be steady at the end: the last slip is held until their means over a turn
  // change by 0.05 % at most. Empty: the sweep ends after its duration.
  std::vector<std::string> steady = {};
  Inflation pressure = {};  // pressure of the tire; the tire's own if not given
};

Result<Channels> run(Tire& tire, const SlipSweep& sweep);

}  // namespace latsch::experiment
