// SPDX-License-Identifier: Apache-2.0
// The usual magnitudes of the numbers of cars, suspensions and the rigs on which they are tested.
// They belong to the table of usual_numbers.h, whose other numbers are those of tires. The ranges
// cover vehicles from a kart to a heavy truck.
#pragma once

#include <vector>

#include "experiment/language/usual_numbers.h"

namespace latsch::experiment {

/// Returns the usual magnitudes of the numbers in files of cars and suspensions.
const std::vector<UsualMagnitude>& usual_of_cars();

/// Returns the usual magnitudes of the numbers in tests of cars and suspensions: K&C rigs,
/// kinematics, four posts, kerbs.
const std::vector<UsualMagnitude>& usual_of_car_tests();

}  // namespace latsch::experiment
