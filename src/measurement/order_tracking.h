// SPDX-License-Identifier: Apache-2.0
// Resamples a signal over the angle of the drum instead of time. Events that are fixed to the drum
// then have a constant order (events per revolution) even if the speed drifts.
//
//   revolutions(t) = 1/U integral v dt,  U the circumference; sampled at equal steps of revolution
#pragma once

#include <span>
#include <vector>

namespace latsch {

/// Returns `per_revolution` samples for each revolution. The speed (m/s, low-passed, positive) has
/// as many samples as x.
std::vector<double> over_revolutions(std::span<const double> x,
                                     std::span<const double> speed,
                                     double rate,
                                     double circumference,
                                     int per_revolution);

}  // namespace latsch
