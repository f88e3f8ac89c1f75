// SPDX-License-Identifier: Apache-2.0
// Inflation on one sector: the state is the same in all sectors, so 260 unknowns replace 15,480.
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

/// Forces on the unknowns of a sector that are linear in the displacements of a state that is the
/// same in all sectors: w_0 + W x, N.
struct LinearLoad {
  numerics::BandedHermitian W;  // matrix of circumferential number 0
  Eigen::VectorXd w_0;
};

/// Adds `factor` times a linear load to an inflated state. The factor is raised at once, in steps
/// that are halved if they do not converge. A Failure says which share of it was reached.
Result<Inflated> load_sector(const RingElements& elements,
                             const Inflated& from,
                             const LinearLoad& load,
                             double factor,
                             const SolverSettings& settings);

/// Works as inflate_sector() on a mesh without symmetry. `reference` is the force norm of the
/// pressure, N.
Result<Inflated> inflate_ring(EquilibriumSolver& solver,
                              const RingElements& elements,
                              double pressure,
                              double reference);

/// Fills growth and radius of an inflated state.
void measure_growth(const Mesh& mesh, Inflated& inflated);

}  // namespace latsch::fe_tire
