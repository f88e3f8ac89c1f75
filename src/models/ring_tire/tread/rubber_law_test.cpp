// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/rubber_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "models/ring_tire/tread/touching_blocks.h"

#define LATSCH_KERNELS_IN "models/ring_tire/tread/rubber_testing.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {
namespace {

constexpr double kBottom = 0.008;  // m

/// Returns the force of a block over its initial stiffness (37) in textbook form.
double neo_hookean(double depth) {
  if (depth <= 0.0) return 0.0;
  const double stretch = 1.0 - depth / kBottom;
  return kBottom / 3.0 * (1.0 / (stretch * stretch) - stretch);
}
/// Returns its strain energy 1/6 (λ² + 2/λ - 3) times b².
double strain_energy(double depth) {
  if (depth <= 0.0) return 0.0;
  const double stretch = 1.0 - depth / kBottom;
  return kBottom * kBottom / 6.0 * (stretch * stretch + 2.0 / stretch - 3.0);
}

TEST(RubberLaw, IsThatOfANeoHookeanBlock) {
  for (const double x : {-0.5, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.7, 0.85, 0.899}) {
    const double depth = x * kBottom, linear = std::max(depth, 0.0);
    const BeyondLinear rubber(depth, kBottom);
    EXPECT_NEAR(linear + rubber.force, neo_hookean(depth), 1e-13 * kBottom / (1.0 - x)) << x;
    EXPECT_NEAR(
        0.5 * linear * linear + rubber.energy, strain_energy(depth), 1e-14 * kBottom * kBottom)
        << x;
    const double h = 1e-5 * kBottom;
    const double slope = (neo_hookean(depth + h) - neo_hookean(depth - h)) / (2.0 * h);
    EXPECT_NEAR((depth > 0.0 ? 1.0 : 0.0) + rubber.slope, slope, 1e-6 * std::max(slope, 1.0)) << x;
  }
  const BeyondLinear linear(0.5 * kBottom, 0.0);
  EXPECT_EQ(linear.force, 0.0);
  EXPECT_EQ(linear.slope, 0.0);
  EXPECT_EQ(linear.energy, 0.0);
}

// A block pressed by more than its height pushes back harder, without a pole or a jump of the
// slope.
TEST(RubberLaw, GoesOnBeyondItsPole) {
  const double edge = kLinearFrom * kBottom, h = 1e-9 * kBottom;
  const BeyondLinear before(edge - h, kBottom), after(edge + h, kBottom);
  EXPECT_NEAR(after.force - before.force, 2.0 * h * before.slope, 1e-3 * h * before.slope);
  EXPECT_NEAR(after.slope / before.slope, 1.0, 1e-6);
  double last = before.force;
  for (const double x : {0.95, 1.0, 1.5, 10.0}) {
    const BeyondLinear rubber(x * kBottom, kBottom);
    EXPECT_GT(rubber.force, last + 30.0 * (x - 0.95) * kBottom);
    EXPECT_EQ(rubber.slope, after.slope);
    const double more = BeyondLinear(x * kBottom + 1e-6, kBottom).energy,
                 less = BeyondLinear(x * kBottom - 1e-6, kBottom).energy;
    EXPECT_NEAR((more - less) / 2e-6, rubber.force, 1e-9 * rubber.force);
    last = rubber.force;
  }
}

struct Cell {
  double share, depth, moment, slope;
};
std::vector<Cell> cells_of_all_sets(double depth, double g, double bottom) {
  std::vector<Cell> cells;
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    double touch[4];
    LATSCH_KERNEL(touch_of)(depth, g, bottom, touch);
    cells.push_back({touch[0], touch[1], touch[2], touch[3]});
  }
  return cells;
}

/// Returns means over the cell of (37) and of ξ times it, by thin blocks.
Cell of_thin_blocks(double depth, double g) {
  constexpr int kThin = 20000;
  Cell mean{};
  for (int i = 0; i < kThin; ++i) {
    const double xi = (2.0 * i + 1.0) / kThin - 1.0, at = depth + g * xi;
    mean.depth += neo_hookean(at) / kThin;
    mean.moment += xi * neo_hookean(at) / kThin;
    mean.share += (at > 0.0 ? 1.0 : 0.0) / kThin;
  }
  return mean;
}

// If all of a cell touches, two points have an error of g⁴/270 times the fourth derivative of (37),
// 40/λ^6, in the force, and of 2/135 g³ times the third derivative, 8/λ^5, in the moment, plus
// terms smaller by (g/b)².
TEST(RubberLaw, CellsAreTheMeanOfThinBlocksToThirdOrder) {
  for (const double x : {0.25, 0.5})
    for (const double slope : {0.05, 0.1}) {
      const double left = 1.0 - x;
      const Cell exact = of_thin_blocks(x * kBottom, slope * kBottom);
      for (const Cell& found : cells_of_all_sets(x * kBottom, slope * kBottom, kBottom)) {
        const double force = std::pow(slope, 4) / 270.0 * 40.0 * std::pow(left, -6.0),
                     moment = 2.0 / 135.0 * std::pow(slope, 3) * 8.0 * std::pow(left, -5.0);
        const double smaller = 10.0 * slope * slope / (left * left);
        EXPECT_NEAR((exact.depth - found.depth) / kBottom / force, 1.0, smaller)
            << x << " " << slope;
        EXPECT_NEAR((exact.moment - found.moment) / kBottom / moment, 1.0, smaller)
            << x << " " << slope;
      }
    }
}

// At the edge of the contact a cell is pressed by at most 2 |g|: the error of two points in its
// excess over linear rubber is below 2 % of g times g/b.
TEST(RubberLaw, CellsAtTheEdgeOfTheContactAreNearThatMean) {
  for (const double g : {2e-4, -4e-4})
    for (const double depth : {-3e-4, -1e-4, 0.0, 1e-4, 3e-4})
      for (const Cell& found : cells_of_all_sets(depth, g, kBottom)) {
        const Cell exact = of_thin_blocks(depth, g);
        EXPECT_NEAR(found.depth, exact.depth, 0.02 * g * g / kBottom + 1e-9) << depth << " " << g;
        EXPECT_NEAR(found.share, exact.share, 1e-3) << depth << " " << g;
      }
}

// Force, moment and stiffness are derivatives of one energy, that of CellSquares, by the depth and
// by its increase along the cell. Kernels of every set fulfill this, also with linear rubber.
TEST(RubberLaw, ForceMomentAndSlopeOfACellFollowFromItsEnergy) {
  const double h = 1e-8;
  for (const double bottom : {0.0, kBottom})
    for (const double g : {3e-4, -1e-3})
      for (const double depth : {-2e-4, 1e-4, 2e-3, 5e-3, 7.5e-3})
        for (const Cell& cell : cells_of_all_sets(depth, g, bottom)) {
          const auto energy = [&](double by_depth, double by_g) {
            return 0.5 * CellSquares(depth + by_depth, g + by_g, bottom).mean;
          };
          const auto force = [&](double by_depth, double by_g) {
            return cells_of_all_sets(depth + by_depth, g + by_g, bottom).front();
          };
          const CellSquares squares(depth, g, bottom);
          EXPECT_NEAR((energy(h, 0.0) - energy(-h, 0.0)) / (2.0 * h), cell.depth, 1e-6 * kBottom);
          EXPECT_NEAR((energy(0.0, h) - energy(0.0, -h)) / (2.0 * h), cell.moment, 1e-6 * kBottom);
          EXPECT_NEAR(squares.first_moment, cell.moment, 1e-12 * kBottom);
          EXPECT_NEAR(squares.by_depth, cell.slope, 1e-11 * cell.slope);
          const double largest = std::max(1.0, cell.slope);
          const Cell deeper = force(h, 0.0), higher = force(-h, 0.0), steeper = force(0.0, h),
                     flatter = force(0.0, -h);
          EXPECT_NEAR((deeper.depth - higher.depth) / (2.0 * h), cell.slope, 1e-6 * largest)
              << depth << " " << g;
          EXPECT_NEAR((deeper.moment - higher.moment) / (2.0 * h), squares.by_both, 1e-6 * largest);
          EXPECT_NEAR(
              (steeper.moment - flatter.moment) / (2.0 * h), squares.by_half, 1e-6 * largest);
        }
}

}  // namespace
}  // namespace latsch::ring_tire
