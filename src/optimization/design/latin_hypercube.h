// SPDX-License-Identifier: Apache-2.0
// Maximin Latin hypercube: points that are spread over every single variable and, at once, as far
// from each other as they can be.
//
// The range of every variable is cut into `points` equal shares of the unit cube; each share holds
// one point, in its middle [McKay, Beckman, Conover, Technometrics 21 (1979) 239]. Which share
// meets which is a permutation a variable. They start at random and are improved by exchanges
// [Morris, Mitchell, J. Statist. Plann. Inference 43 (1995) 381]:
//
//   phi_p = (sum over pairs of d_ij^-p)^(1/p)       d_ij: Euclidean distance of points i and j
//
// whose minimum tends for large p to the largest least distance. Of all exchanges of one coordinate
// between a point of the closest pair and any other, the one that lowers phi_p the most is made,
// until none does; small designs keep the best of up to 20 starts. So it is a local optimum, and a
// function of the seed alone.
//
// Choose ten points a variable to start with [Loeppky, Sacks, Welch, Technometrics 51 (2009) 366].
#pragma once

#include <cstdint>

#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch {

inline constexpr int kMostLatinHypercubePoints =
    300;  // exchanges cost their cube; Sobol takes more

/// Throws InputError for less than two points or more than kMostLatinHypercubePoints.
SamplingPlan latin_hypercube(const DesignSpace& space, int points, std::uint64_t seed = 0);

}  // namespace latsch
