// SPDX-License-Identifier: Apache-2.0
// Rubber of a tread block under pressure: neo-Hookean, incompressible, sides free [Rivlin 1948].
// A block of height b that is pressed in by δ carries, per its area at rest,
//   p = E/3 (1/λ² - λ),  λ = 1 - δ/b                                                          (37)
// which is linear with E/b for small δ and without bound if the block is pressed to nothing. In
// shear a pressed block keeps its stiffness G A/b: it gets wider as it gets thinner, so (12) does
// not change.
//
// b is the tread's height if the rubber can expand freely to the sides. If it fills voids instead,
// it bottoms out sooner: when the pattern is flat, at 1 - positive of the height, unless rubber
// leaves. The stiffness at small δ is that of the full height in any case.
//
// Beyond kLinearFrom of b the law continues with its slope there, 667 times that at small δ. A
// trial step may press a block by more than its height and then still returns.
#pragma once

#include <algorithm>
#include <cmath>

namespace latsch::ring_tire {

constexpr double kLinearFrom = 0.9;

/// Difference of (37) to a linear spring of its initial stiffness, over that stiffness.
struct BeyondLinear {
  double energy = 0.0;  // m^2; of a linear spring: δ²/2
  double force = 0.0;   // m; of a linear spring: δ
  double slope = 0.0;   // dimensionless; of a linear spring: 1

  BeyondLinear() = default;
  /// The block is pressed by `depth`, negative above the road; `bottom` is b, 0 for linear rubber.
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

/// ξ of the two points by which a cell, ξ = -1 .. 1, is averaged. Exact to third order in the
/// increase of depth along the cell; the derivatives of that mean are the cell's force and moment.
constexpr double kGauss = 0.57735026918962576;  // 1/√3

}  // namespace latsch::ring_tire
