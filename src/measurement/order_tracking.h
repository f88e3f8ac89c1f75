// SPDX-License-Identifier: Apache-2.0
// A signal over the angle of the drum instead of over time: what turns with the drum then has the
// same order (events a revolution) however the speed drifts.
//
//   revolutions(t) = 1/U integral v dt,  U the circumference; read at equal steps of it
#pragma once

#include <span>
#include <vector>

#include "numerics/signals/welch.h"

namespace latsch {

/// `per_revolution` samples each. The speed (m/s, low-passed) has as many samples as x; positive.
std::vector<double> over_revolutions(std::span<const double> x,
                                     std::span<const double> speed,
                                     double rate,
                                     double circumference,
                                     int per_revolution);

/// Density over the order, unit^2 per order, over `revolutions` a segment (Hann).
numerics::Density order_density(std::span<const double> over_revolutions,
                                int per_revolution,
                                int revolutions);

}  // namespace latsch
