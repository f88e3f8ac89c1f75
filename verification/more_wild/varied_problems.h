// SPDX-License-Identifier: Apache-2.0
// Variations of the Moré-Wild problems. A method can be chosen with them without using the problems
// by which it is judged.
//
//   moved     start at  x_0 + 0.1 max(|x_i|, 0.1 |x_0|_inf) N(0, 1)
//   rotated   variables y:  x = x_0 + Q (y - x_0), Q a random rotation
//   scaled    variables y:  x_i = x_0i + s_i (y_i - x_0i),  s_i = 10^U(-1, 1)
//
// f_L remains that of the standard start. From a moved start the search may lead to another
// minimum: shares of solved problems compare methods and need not reach 1.
#pragma once

#include <cstdint>

#include "more_wild/more_wild_problems.h"

namespace latsch::more_wild {

std::vector<Problem> moved(std::uint64_t seed);
std::vector<Problem> rotated(std::uint64_t seed);
std::vector<Problem> scaled(std::uint64_t seed);

}  // namespace latsch::more_wild
