// SPDX-License-Identifier: Apache-2.0
// A tire that does not roll: force over deflection, on flat ground or on a cleat below its middle,
// and stiffness in the longitudinal, lateral, vertical and torsional directions under a load on
// flat ground. For any tire.
//
// The axle is moved slowly from its position and held; the stiffness is the change of the hub's
// force over the displacement, including the effect of friction in the contact patch. The keys are
// in experiment/tests/keys/static_stiffness_keys.cpp.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/result.h"
#include "experiment/rigs/cleat.h"
#include "experiment/rigs/inflation.h"
#include "measurement/channels.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

/// Vertical force, N, at a deflection, m, which is the depth of the undeformed tire in the ground
/// below its middle, or in the top of the cleat if there is one.
Result<double> load_at(Tire& tire, double deflection, const std::optional<Cleat>& cleat = {});

enum class Direction { vertical, longitudinal, lateral, torsional };
inline constexpr std::array<const char*, 4> kDirections = {
    "vertical", "longitudinal", "lateral", "torsional"};
const char* name_of(Direction direction);
const char* unit_of(Direction direction);

struct StiffnessTest {
  Direction direction = Direction::vertical;
  double load = 4000.0;  // N
  double camber = 0.0;   // rad
  double travel = 1e-3;  // m; rad for the torsional test
  double ramp = 0.3;     // s, slow compared with every mode of a tire
  double hold = 0.1;     // s, for the motion to decay
  double step = 1e-3;    // s
};

/// Returns the stiffness, N/m; for torsion N m/rad.
Result<double> stiffness(Tire& tire, const StiffnessTest& test);

/// The complete test with all its directions.
struct StandingTest {
  std::vector<double> deflections = {};  // m, on the cleat
  std::optional<Cleat> cleat = {};
  double load = 0.0;  // N
  std::vector<Direction> directions = {};
  double camber = 0.0;                 // rad
  double travel = 1e-3, twist = 1e-3;  // m, rad: so small that the patch hardly slides
  std::optional<double> friction = {};
  Inflation pressure = {};
};

/// Returns its channels: force over deflection, and one stiffness for each direction.
Channels standing_channels(const StandingTest& test,
                           const std::vector<double>& forces,
                           const std::vector<double>& stiffnesses);
Result<Channels> stand(Tire& tire, const StandingTest& test);

}  // namespace latsch::experiment
