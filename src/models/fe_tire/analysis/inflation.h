// SPDX-License-Identifier: Apache-2.0
// Inflation on one sector: the state is the same in all of them, so 260 unknowns stand for 15,480.
#pragma once

#include "base/result.h"
#include "models/fe_tire/analysis/equilibrium.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/ring/ring.h"

namespace latsch::fe_tire {

/// Newton's method on the axisymmetric equilibrium f(x; p) = 0, the pressure raised in steps that
/// halve where a step does not converge. Failure names pressure, residual and worst element. From
/// displacements `near` the equilibrium, where there are any, at once if it can be.
Result<Inflated> inflate_sector(const RingElements& elements,
                                double pressure,
                                const SolverSettings& settings,
                                const Eigen::Matrix3Xd* near = nullptr);

/// The same on a mesh without symmetry; `reference` is the force norm of the pressure, N.
Result<Inflated> inflate_ring(EquilibriumSolver& solver,
                              const RingElements& elements,
                              double pressure,
                              double reference);

/// Fills growth and radius of an inflated state.
void measure_growth(const Mesh& mesh, Inflated& inflated);

}  // namespace latsch::fe_tire
