// SPDX-License-Identifier: Apache-2.0
// Maximin Latin hypercube: points that are spread evenly over the range of every single variable
// and are at the same time as far from each other as possible.
//
// The range of every variable is divided into as many equal shares of the unit cube as there are
// points. Each share holds one point, in its middle [McKay, Beckman, Conover, Technometrics 21
// (1979) 239]. One permutation for each variable assigns the shares to the points. The permutations
// start at random and are improved by exchanges [Morris, Mitchell, J. Statist. Plann. Inference 43
// (1995) 381], which lower
//
//   phi_p = (sum over pairs of d_ij^-p)^(1/p)       d_ij: Euclidean distance of points i and j
//
// For large p the minimum of phi_p tends to the design whose closest points are farthest apart. An
// exchange swaps one coordinate between a point of the closest pair and any other point. The
// exchange that lowers phi_p the most is made, until no exchange lowers it. Small designs keep the
// best of up to 20 starts. The result is a local optimum and depends on the seed alone.
//
// Choose ten points for each variable to start with [Loeppky, Sacks, Welch, Technometrics 51 (2009)
// 366].
#pragma once

#include <cstdint>

#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch {

/// The time of the exchanges grows with the cube of the number of points; for more points use
/// Sobol.
inline constexpr int kMostLatinHypercubePoints = 300;

/// Throws InputError for less than two points or more than kMostLatinHypercubePoints.
SamplingPlan latin_hypercube(const DesignSpace& space, int points, std::uint64_t seed = 0);

}  // namespace latsch
