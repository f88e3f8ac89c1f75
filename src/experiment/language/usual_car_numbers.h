// SPDX-License-Identifier: Apache-2.0
// The usual magnitudes of a car, of its suspensions and of the rigs on which they are tested: the
// part of the table of usual_numbers.h that is no tire's. The ranges cover vehicles from a kart to
// a heavy truck.
#pragma once

#include <vector>

#include "experiment/language/usual_numbers.h"

namespace latsch::experiment {

/// Quantities of a car's file and of a suspension's.
const std::vector<UsualMagnitude>& usual_of_cars();

/// Quantities of the tests of cars and suspensions: K&C rigs, kinematics, four posts, kerbs.
const std::vector<UsualMagnitude>& usual_of_car_tests();

}  // namespace latsch::experiment
