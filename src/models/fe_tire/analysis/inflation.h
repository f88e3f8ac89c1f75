// SPDX-License-Identifier: Apache-2.0
// Inflation of the tire, computed on one sector. The state is the same in all sectors, so that 260
// unknowns replace 15,480.
#pragma once

#include "base/result.h"
#include "models/fe_tire/analysis/equilibrium.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/ring/ring.h"
#include "numerics/sparse/banded_hermitian.h"

namespace latsch::fe_tire {

/// Solves the axisymmetric equilibrium f(x; p) = 0 by Newton's method. The pressure is raised in
/// steps that are halved if they do not converge. A Failure names pressure, residual and worst
/// element. If displacements `near` the equilibrium are given, the full pressure is first tried at
/// once from them.
Result<Inflated> inflate_sector(const RingElements& elements,
                                double pressure,
                                const SolverSettings& settings,
                                const Eigen::Matrix3Xd* near = nullptr);

/// Forces on the unknowns x of a sector that are linear in x: w_0 + W x, N. The state must be the
/// same in all sectors.
struct LinearLoad {
  numerics::BandedHermitian W;  // matrix for the circumferential number 0
  Eigen::VectorXd w_0;
};

/// Adds `factor` times a linear load to an inflated state. The whole factor is tried at once; if
/// this does not converge, steps are halved. A Failure says which share was reached.
Result<Inflated> load_sector(const RingElements& elements,
                             const Inflated& from,
                             const LinearLoad& load,
                             double factor,
                             const SolverSettings& settings);

/// Inflates a mesh without rotational symmetry; otherwise like inflate_sector(). `reference` is the
/// force norm of the pressure, N.
Result<Inflated> inflate_ring(EquilibriumSolver& solver,
                              const RingElements& elements,
                              double pressure,
                              double reference);

/// Sets growth, radius and width of an inflated state from its displacements.
void measure_growth(const Mesh& mesh, Inflated& inflated);

}  // namespace latsch::fe_tire
