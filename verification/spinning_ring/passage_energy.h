// SPDX-License-Identifier: Apache-2.0
// Energy of a tire that rolls in time over smooth ground without friction, with a held axle and a
// spin that stays. The equation of motion is that of the function
//   H = 1/2 v M v + V(u) - Omega^2 (w_0 u + 1/2 u W u) + 1/2 epsilon sum of (depth^2 dA)      (V.7)
// of the displacements u and their rates v, since the gyroscopic forces do no work. V holds the
// strain and the work of the pressure. H changes while a cleat passes, which does work, and is
// constant before and after it. Differences of V are integrals of the internal forces along a
// straight line by Gauss quadrature, so nothing here knows the steps of time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/fe_tire/description/tire_description.h"

namespace latsch::verification {

struct PassageEnergy {
  /// H at the times of `samples`, J, less that of the steady state before the cleat.
  std::vector<double> H;
};

/// A passage of an elastic tire over a cleat, and its steps.
struct EnergyPassage {
  double deflection = 0.02, speed = 30.0;  // m, m/s
  double step = 5e-4, rho = 1.0;           // s; share left of high frequencies
  double height = 5e-3, length = 0.02;     // m, of the cleat
  double after = 0.02;                     // s, recorded after the cleat has left the patch
};
/// Rolls the tire over a cleat and returns H at the end of every step after the cleat has left.
/// Throws std::runtime_error if a step fails.
PassageEnergy energy_after_cleat(const fe_tire::TireDescription& tire,
                                 const EnergyPassage& passage);

/// Change of H from the first half of a record to the second, relative to its mean: both are means,
/// because vibration does not change H and rounding of steps does.
double drift(const PassageEnergy& record);

}  // namespace latsch::verification
