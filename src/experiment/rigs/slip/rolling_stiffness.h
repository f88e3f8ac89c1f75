// SPDX-License-Identifier: Apache-2.0
// Characteristic slopes of a rolling tire: its response to a small slip, slip angle or camber at
// free rolling. For any tire.
//
// On the flat track (flat_track.h), its axle following the load, the wheel rolls with the value and
// with its opposite until both are steady (steady_rolling.h); forces are means over a turn of the
// wheel:
//
//   slip stiffness        C_κ = (Fx(κ) - Fx(-κ))/2κ
//   cornering stiffness   C_α = -(Fy(α) - Fy(-α))/2α
//   pneumatic trail       t = -(Mz(α) - Mz(-α))/(Fy(α) - Fy(-α))
//   camber stiffness      C_γ = -(Fy(γ) - Fy(-γ))/2γ, above 0: toward the side it leans to
//
// Forces are in W (NOTATION.md). Each difference includes the reduction of C by friction at that
// slip.
//
// The keys are in experiment/tests/keys/rolling_stiffness_keys.cpp.
#pragma once

#include "base/result.h"
#include "experiment/rigs/inflation.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

struct RollingStiffnessTest {
  double speed = 60.0 / 3.6;              // m/s
  double load = 4000.0;                   // N
  double slip = 2e-3;                     // slip ratio κ of the two states, positive and negative
  double angle = 0.25 * 0.0174532925199;  // rad, α
  double camber = 1.0 * 0.0174532925199;  // rad, γ
  double step = 5e-4;                     // s
  Inflation pressure = {};                // pressure of the tire; the tire's own if not given
};

struct Cornering {
  double stiffness, trail;  // N/rad, m
};

/// Result in N.
Result<double> slip_stiffness(Tire& tire, const RollingStiffnessTest& test);
Result<Cornering> cornering(Tire& tire, const RollingStiffnessTest& test);
/// Returns the camber stiffness, N/rad.
Result<double> camber_stiffness(Tire& tire, const RollingStiffnessTest& test);

}  // namespace latsch::experiment
