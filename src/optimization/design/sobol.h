// SPDX-License-Identifier: Apache-2.0
// Sobol's low-discrepancy sequence fills the unit cube ever more evenly, point by point, so a
// design can be enlarged without losing what was evaluated.
//
// Coordinate j of point n is the exclusive or of those direction numbers v_k whose bit k is set in
// n's Gray code n xor n/2 [Sobol, USSR Comput. Math. Math. Phys. 7 (1967) 86; order by Antonov and
// Saleev, ibid. 19 (1979) 252]. For a primitive polynomial x^s + a_1 x^(s-1) + ... + a_(s-1) x + 1
// and given numbers m_1 .. m_s, the direction numbers v_k = m_k / 2^k follow from (^: exclusive or)
//   m_k = 2 a_1 m_(k-1) ^ 4 a_2 m_(k-2) ^ ... ^ 2^s m_(k-s) ^ m_(k-s).
// Polynomials and m_1 .. m_s are those of [Joe, Kuo, SIAM J. Sci. Comput. 30 (2008) 2635], table
// new-joe-kuo-6.21201, up to 21 variables.
//
// The first 2^k points are evenly distributed (a digital net), so choose a power of two. Point 0 is
// a corner of the cube, with every variable at its lower bound; it belongs to the net and is kept.
// A seed other than 0 shifts all binary digits by random ones. The shifted points are still a net,
// and point 0 moves inside the cube.
#pragma once

#include <cstdint>

#include "optimization/design/sampling_plan.h"
#include "optimization/problem/design_space.h"

namespace latsch {

/// Largest number of variables that the table covers.
inline constexpr int kMostSobolVariables = 21;

/// Returns the first `points` points of the sequence. Throws InputError for less than one or more
/// than a million points, or for more than kMostSobolVariables variables.
SamplingPlan sobol(const DesignSpace& space, int points, std::uint64_t seed = 0);

}  // namespace latsch
