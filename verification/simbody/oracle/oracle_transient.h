// SPDX-License-Identifier: Apache-2.0
// A case over time, from its equilibrium, by an integrator of Simbody with control of its error:
// CPODES' BDF with Newton's method, or the explicit pair of Merson as a check of it.
#pragma once

#include "oracle_model.h"

namespace oracle {

constexpr double kUsualAccuracy = 1e-9;  // of Simbody's integrators: error of a step, relative

struct TransientWork {
  int steps, evaluations;
};

/// Prints time and the displacement of every output point, m, from where it is at rest.
TransientWork print_transient(const Case& data, double accuracy, bool explicitly);

}  // namespace oracle
