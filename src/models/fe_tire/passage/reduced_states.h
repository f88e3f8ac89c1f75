// SPDX-License-Identifier: Apache-2.0
// Steady states of a reduced tire, and how far it is from the full one.
//
// In a steady state nothing changes at a place, so (V.9) is
//   K q + sum_r K_r sum_i beta_ri (Omega D + 1/tau_ri)^-1 Omega D q = Phi' B (c - c_0)      (V.11)
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/result.h"
#include "models/fe_tire/passage/reduced_tire.h"
#include "models/fe_tire/rolling/rolling_case.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {

/// Returns the matrix of (V.11) [shapes x shapes].
Eigen::MatrixXd steady_stiffness(const ReducedTire& tire);

/// Returns the forces of the ground in a steady state with the spin of `tire` that is asked for by
/// its height, angles, speed, turn slip and friction. `from`: states of all points of the tread in
/// the steady state of the tire. A Failure says that the contact was not found.
Result<RollingForces> steady_forces(const ReducedTire& tire,
                                    const GripState& from,
                                    const RollingCase& of);

/// Forces of both tires at another height.
struct ReducedError {
  double lower;  // m, by which the wheel is lower than in the steady state of the reduced tire
  double full, reduced;  // N, changes of Fz from there
  double error() const { return reduced / full - 1.0; }
};

/// Compares a reduced tire with the full one, from whose steady state it was made, at heights that
/// are lower by each of `lower`, m. A Failure says that a state was not found.
Result<std::vector<ReducedError>> reduced_errors(RollingTire& full,
                                                 const RollingState& steady,
                                                 const ReducedTire& tire,
                                                 const std::vector<double>& lower);

}  // namespace latsch::fe_tire
