// SPDX-License-Identifier: Apache-2.0
// Virtual flat-track machine: the belt runs below a standing wheel that is steered or braked from
// one end of a range of slip to the other. Of any tire.
//
// As on the machine the axle follows the load: it rises where the tire pushes harder than `load`,
//   z' = (Fz - load)/c,   c = 20 ms load/deflection,
// so that Fz returns to the load with some 20 ms; or it is held at the height where the standing
// tire carries the load. Free wheel and axle are solved with the tire's step (free_wheel.h).
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

/// What the axle keeps.
enum class Axle { load, height };

struct SlipSweep {
  double speed = 10.0;   // m/s, of the belt
  double load = 4000.0;  // N
  Axle axle = Axle::load;
  std::vector<AxisFrame> frames = {AxisFrame::W};  // of the forces
  double camber = 0.0;                             // rad
  double alpha_from = 0.0, alpha_to = 0.0;         // rad
  double kappa_from = 0.0, kappa_to = 0.0;
  double run_in = 0.3;      // s, free rolling, then at the first slip of the sweep
  double duration = 1.0;    // s, of the sweep
  double step = 5e-4;       // s
  Inflation pressure = {};  // of the tire that is given to it
};

Result<Channels> run(Tire& tire, const SlipSweep& sweep);

}  // namespace latsch::experiment
