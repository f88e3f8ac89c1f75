// SPDX-License-Identifier: Apache-2.0
// Standing tire on flat ground: force over deflection, and stiffness along, across and about the
// vertical under a load. Of any tire.
//
// The axle is moved slowly from where the tire stands and held; the stiffness is the change of the
// hub's force over the way, with the friction of the patch in it.
#pragma once

#include "base/result.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

/// N, vertical force at a deflection from first touch, m.
Result<double> load_at(Tire& tire, double deflection);

enum class Direction { vertical, longitudinal, lateral, torsional };

struct StiffnessTest {
  Direction direction = Direction::vertical;
  double load = 4000.0;  // N
  double travel = 1e-3;  // m; of the torsional test rad
  double ramp = 0.3;     // s, slow against every mode of a tire
  double hold = 0.1;     // s, for what moved to come to rest
  double step = 1e-3;    // s
};

/// N/m, of the torsional test N m/rad.
Result<double> stiffness(Tire& tire, const StiffnessTest& test);

}  // namespace latsch::experiment
