// SPDX-License-Identifier: Apache-2.0
// Rubber of a tread block under pressure: neo-Hookean, incompressible, sides free [Rivlin 1948].
// A block of height b that is pressed in by δ carries, per its area at rest,
//   p = E/3 (1/λ² - λ),  λ = 1 - δ/b                                                          (37)
// linear with E/b where δ is small and without bound where the block is pressed to nothing. In
// shear a pressed block is as stiff as ever, G A/b: it gets wider as it gets thinner, so (12) stays
// as it is.
//
// b is the tread's height where rubber has all the room it wants to the sides. Where it fills voids
// instead it bottoms out sooner: when the pattern is flat, at 1 - positive of the height, unless
// rubber leaves. The stiffness of small δ is that of the full height in any case.
//
// Beyond kLinearFrom of b it goes on with its slope there, 667 times that of small δ: a trial step
// may press a block by more than there is of it, and finds its way back.
#pragma once

#include <algorithm>
#include <cmath>

namespace latsch::ring_tire {

constexpr double kLinearFrom = 0.9;

/// What (37) has beyond a linear spring of its first stiffness, over that stiffness.
struct BeyondLinear {
  double energy = 0.0;  // m^2, of a linear spring: δ²/2
  double force = 0.0;   // m, δ
  double slope = 0.0;   // 1

  BeyondLinear() = default;
  /// Pressed in by `depth`, above the road where negative; `bottom`: b, 0 of rubber that is linear.
  BeyondLinear(double depth, double bottom) {
    if (!(bottom > 0.0)) return;
    const double x = std::clamp(depth / bottom, 0.0, kLinearFrom),
                 over = std::max(depth / bottom - kLinearFrom, 0.0), r = 1.0 / (1.0 - x);
    const double at_x = x * x * (1.0 - 2.0 / 3.0 * x) * r * r;
    slope = 2.0 / 3.0 * (r * r * r - 1.0);
    force = bottom * (at_x + slope * over);
    energy = bottom * bottom * (x * x * x * r / 3.0 + over * (at_x + 0.5 * slope * over));
  }
};

/// ξ of the two points by which a cell, ξ = -1 .. 1, has the mean of it. Exact to third order in
/// the depth's gain along the cell; the derivatives of that mean are the cell's force and moment.
constexpr double kGauss = 0.57735026918962576;  // 1/√3

}  // namespace latsch::ring_tire
