// SPDX-License-Identifier: Apache-2.0
// Equilibrium by Newton's method on Simbody's forces r(x): a Jacobian of central differences, new
// at every iteration, and a dense factorization.
//   x <- x - (dr/dx)^-1 r,   x: travel and rotation vector of every body
#pragma once

#include "oracle_model.h"

namespace oracle {

struct Statics {
  SimTK::State state;
  double left;  // N, N m: the largest that is left
  int iterations;
};

/// Throws where more than 1e-7 N is left.
Statics solve_statics(const Model& model);

}  // namespace oracle
