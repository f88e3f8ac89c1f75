// SPDX-License-Identifier: Apache-2.0
// Simulates a case over time, from its equilibrium, by an integrator of Simbody with error control.
// "explicit" is Merson's pair of orders 4 and 5: its steps of 75 µs, limited by the light rods in
// their bushings, are not much shorter than the accuracy requires. "cpodes" is BDF with Newton's
// method; it is seven times as slow because of its dense Jacobian of differences, and serves to
// check the first by another method.
#pragma once

#include "oracle_model.h"

namespace oracle {

constexpr double kUsualAccuracy = 1e-9;  // relative error of a step in Simbody's integrators

struct TransientWork {
  int steps, evaluations;
};

/// Prints the time and the displacement, m, of every output point from its position at rest.
TransientWork print_transient(const Case& data, double accuracy, const std::string& method);

}  // namespace oracle
