// SPDX-License-Identifier: Apache-2.0
// Virtual uniformity machine: a tire rolls slowly at a constant loaded radius, forward and
// backward, and the force on its spindle varies over the turn. For any tire.
//
// Channels, N: "load"; RFV, LFV, TFV, peak to peak over a turn forward, "radial_force_variation",
// "lateral_force_variation", "tangential_force_variation"; the first harmonic of each, peak to peak
// as well, "radial_first_harmonic", "lateral_first_harmonic", "tangential_first_harmonic";
// "conicity" and "ply_steer". A variation is the sum of the first `harmonics` harmonics, so that
// segments of a belt and blocks of a tread do not count.
//
// Forces are those on the wheel in C, whose axes stay with the wheel: x to the front, y to the
// left, z up (NOTATION.md). Rolling forward the wheel turns clockwise as seen from its right side.
// With F the mean of Fy rolling forward, B rolling backward,
//   conicity   (F + B)/2,  has the same side in both directions
//   ply steer  (F - B)/2,  changes sides with the direction
// they are half the sum and half the difference of the lateral shifts, clockwise and
// counterclockwise. Such machines are the subject of SAE J332. Above a few m/s imbalance and modes
// of the tire contribute to the variations, as on machines for high speeds.
//
// The keys are in experiment/tests/keys/uniformity_keys.cpp.
#pragma once

#include <vector>

#include "base/document.h"
#include "base/result.h"
#include "experiment/rigs/inflation.h"
#include "experiment/rigs/measured_conditions.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

struct UniformityTest {
  double load = 4000.0;        // N
  double diameter = 0.0;       // m, of the drum; 0: flat
  double speed = 2.0;          // m/s
  double wheel_inertia = 1.0;  // kg m^2
  int harmonics = 10;
  double step = 1e-3;       // s
  Inflation pressure = {};  // pressure of the tire; the tire's own if not given
};

/// Peak-to-peak variation of a force over a turn, N.
struct ForceVariation {
  double all = 0.0, first = 0.0;
};

/// Forces in N.
struct UniformityRecord {
  double load = 0.0;
  ForceVariation radial, lateral, tangential;
  double conicity = 0.0, ply_steer = 0.0;
};

/// Throws InputError naming the place.
UniformityTest read_uniformity_test(const Node& root, const MeasuredConditions& measured = {});

/// Runs the test; the tire keeps its final state.
Result<UniformityRecord> run(Tire& tire, const UniformityTest& test);

/// Variation of values at equal spacing over a turn: the sum of their harmonics 1 to `harmonics`,
/// at most half as many as values.
ForceVariation variation_of(const std::vector<double>& values, int harmonics);

}  // namespace latsch::experiment
