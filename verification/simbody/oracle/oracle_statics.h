// SPDX-License-Identifier: Apache-2.0
// Equilibrium by Newton's method on Simbody's forces r(x), with a Jacobian by central differences,
// recomputed at every iteration, and a dense factorization.
//   x <- x - (dr/dx)^-1 r,   x: displacement and rotation vector of every body
#pragma once

#include "oracle_model.h"

namespace oracle {

struct Statics {
  SimTK::State state;
  double left;  // N, N m: largest residual
  int iterations;
};

/// Throws if the residual exceeds 1e-7 N.
Statics solve_statics(const Model& model);

}  // namespace oracle
