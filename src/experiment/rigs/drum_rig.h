// SPDX-License-Identifier: Apache-2.0
// Virtual drum rig: a tire on a drum with a cleat; the axle is held at one height, the wheel spins
// freely.
//
//   kind = "drum_cleat"
//   speed = "60 km/h"                # of the drum's surface
//   load = "4 kN"                    # at rest, before the axle is held; or deflection = "20 mm";
//                                    # speed and load may be {from = "measurement.rolling"}: the
//                                    # means of its Vx and Fz
//   pressure = "2.6 bar"             # the tire's own unless given (inflation.h)
//   camber = "2 deg"                 # about x, top to the right; default 0
//   drum_diameter = "2.5 m"          # from 0.2 to 100 m
//   wheel_inertia = "1 kg m^2"       # about the spin axis, default 1
//   run_in = "0.2 s"                 # of rolling before the cleat, in which the wheel is
//                                    # gradually released from the speed it started with
//   duration = "0.25 s"              # recorded, from `lead` before the cleat is below the axle
//   lead = "0.05 s"
//   step = "0.5 ms"                  # of the simulation; moves the tire by 20 mm at most
//   sample_step = "1 ms"             # of the record; a multiple of step, default step
//   passages = 4                     # of the cleat, averaged; default 1
//   wheel_step = "0.75 deg"          # angle by which the wheel is turned for each further passage
//   wheel_start = "0.3 deg"          # and for the first passage; default 0
//   frame = "W"                      # of the forces recorded: W, H or C (hub_frame.h), that of the
//                                    # measurement; default C, the axes of a hub's load cell;
//                                    # ["C", "W"] records both, "FyC" and "FyW"
//   [cleat]                          # none: a smooth drum
//   height = "15 mm"
//   length = "30 mm"
//   bevel = "5 mm"                   # of its upper edges, default 0
//   angle = "30 deg"                 # against the axle, default 0
//
// Channels: "time" (0 when the cleat is below the axle), hub forces "Fx" .. "Mz" in that frame,
// "speed" of the drum's surface and "wheel_speed" (rad/s). The origin of W is where the wheel plane
// meets the smooth drum. The wheel's spin is solved by steps of the tire (free_wheel.h), with
// order 2.
#pragma once

#include <optional>
#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "experiment/rigs/cleat.h"
#include "experiment/rigs/hub_frame.h"
#include "experiment/rigs/inflation.h"
#include "experiment/rigs/measured_conditions.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

struct DrumTest {
  double speed = 0.0;                     // m/s
  std::optional<double> load = {};        // N; either load or deflection is given
  std::optional<double> deflection = {};  // m
  double camber = 0.0;                    // rad
  Inflation pressure = {};                // pressure of the tire; the tire's own if not given
  double diameter = 2.0;                  // m
  double wheel_inertia = 1.0;             // kg m^2
  double run_in = 0.2, duration = 0.25, lead = 0.05, step = 5e-4, sample_step = 5e-4;  // s
  std::optional<Cleat> cleat = {};
  int passages = 1;
  double wheel_step = 0.0, wheel_start = 0.0;  // rad
  std::vector<AxisFrame> frames = {AxisFrame::C};
};

/// Throws InputError naming the place, also for unknown keys.
DrumTest read_drum_test(const Node& root, const MeasuredConditions& measured = {});

/// Runs any tire; the tire keeps its final state.
Result<Channels> run(Tire& tire, const DrumTest& test);

/// Returns a Failure if a deflection, m, is deeper than the section of any tire of this radius. A
/// tire whose file states its rim refuses less.
Status check_depth(const Tire& tire, double deflection);

/// Longest distance, m, that a tire may move in one step: a block of its tread gains and loses
/// contact within some steps.
constexpr double kFarthestStep = 0.02;
/// Throws InputError if a step moves the tire farther at this speed.
void check_step(const Node& test, double speed, double step);

/// Returns the height of the axle above the road's origin, m, at which the tire carries `load` at
/// rest.
Result<double> height_under_load(Tire& tire,
                                 const road::Road& road,
                                 const Eigen::Matrix3d& carrier,
                                 double load);

}  // namespace latsch::experiment
