// SPDX-License-Identifier: Apache-2.0
// A case over time, from its equilibrium, by an integrator of Simbody with control of its error:
// "explicit", the pair of Merson, orders 4 and 5: steps of 75 µs, which the light rods in their
// bushings bear, are not much shorter than what accuracy asks for; or "cpodes", BDF with Newton's
// method, seven times as slow by its dense Jacobian of differences, as a check by another method.
#pragma once

#include "oracle_model.h"

namespace oracle {

constexpr double kUsualAccuracy = 1e-9;  // of Simbody's integrators: error of a step, relative

struct TransientWork {
  int steps, evaluations;
};

/// Prints time and the displacement of every output point, m, from where it is at rest.
TransientWork print_transient(const Case& data, double accuracy, const std::string& method);

}  // namespace oracle
