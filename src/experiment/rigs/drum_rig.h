// SPDX-License-Identifier: Apache-2.0
// Virtual drum rig: a tire on a drum with a cleat; the axle is held at one height, the wheel spins
// freely.
//
// Channels: "time" (0 when the cleat is below the axle), hub forces "Fx" .. "Mz" in that frame,
// "speed" of the drum's surface and "wheel_speed" (rad/s). The origin of W is where the wheel plane
// meets the smooth drum. The wheel's spin is solved by steps of the tire (free_wheel.h), with
// order 2.
//
// The keys are in experiment/tests/keys/drum_cleat_keys.cpp. A finite-element tire crosses the
// cleat on a rig of its own, fe_rolling/cleat_rig.h.
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

/// Reads a drum test. Throws InputError, which names file, line and key, also for unknown keys.
DrumTest read_drum_test(const Node& root, const MeasuredConditions& measured = {});

/// Runs any tire; the tire keeps its final state.
Result<Channels> run(Tire& tire, const DrumTest& test);

/// Returns the greatest distance, m, between the axle and the middle of an oblique cleat at which
/// the tire may touch the cleat. It is an upper estimate, computed from half the width, m, over
/// which the tire touches the road and from the chord of a wheel that is pressed into the road as
/// deeply as its load may require.
double reach_of_cleat(const DrumTest& test, double free_radius, double half_width);

/// Throws InputError if a step moves the tire farther at this speed.
void check_step(const Node& test, double speed, double step);

/// Returns the height of the axle above the road's origin, m, at which the tire carries `load` at
/// rest.
Result<double> height_under_load(Tire& tire,
                                 const road::Road& road,
                                 const Eigen::Matrix3d& carrier,
                                 double load);

}  // namespace latsch::experiment
