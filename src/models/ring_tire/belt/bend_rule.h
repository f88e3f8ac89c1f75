// SPDX-License-Identifier: Apache-2.0
// Weights of the nodes k-1 .. k+2 at a point where bending, (3) and (4) of belt.h, is evaluated:
// for the curve's position and for its first and second derivative by s.
#pragma once

namespace latsch::ring_tire {

struct BendRule {
  double place[4], slope[4], second[4];
};
constexpr BendRule kAtKnot{
    {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0}, {-0.5, 0.0, 0.5, 0.0}, {1.0, -2.0, 1.0, 0.0}};
constexpr BendRule kBetween{{1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0},
                            {-0.125, -0.625, 0.625, 0.125},
                            {0.5, -0.5, -0.5, 0.5}};

}  // namespace latsch::ring_tire
