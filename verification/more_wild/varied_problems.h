// SPDX-License-Identifier: Apache-2.0
// The Moré-Wild problems as others would have put them: for choosing a method without looking at
// the problems it is judged by.
//
//   moved     from  x_0 + 0.1 max(|x_i|, 0.1 |x_0|_inf) N(0, 1)
//   rotated   the same in y:  x = x_0 + Q (y - x_0), Q a random rotation
//   scaled    the same in y:  x_i = x_0i + s_i (y_i - x_0i),  s_i = 10^U(-1, 1)
//
// f_L stays what it is for the standard start. From a moved one the way may lead to another
// minimum: shares of solved problems compare methods, they need not come to 1.
#pragma once

#include <cstdint>

#include "more_wild/more_wild_problems.h"

namespace latsch::more_wild {

std::vector<Problem> moved(std::uint64_t seed);
std::vector<Problem> rotated(std::uint64_t seed);
std::vector<Problem> scaled(std::uint64_t seed);

}  // namespace latsch::more_wild
