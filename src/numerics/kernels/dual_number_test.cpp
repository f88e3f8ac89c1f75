// SPDX-License-Identifier: Apache-2.0
// Tests slopes of elementary functions against their closed forms.
#include "numerics/kernels/dual_number.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/kernels/kernel_set.h"

namespace latsch::dual_lanes_testing {
constexpr int kFunctions = 12;
}
#define LATSCH_KERNELS_IN "numerics/kernels/dual_lanes_testing.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::dual_lanes_testing {
namespace {

constexpr int kX = 0, kY = 5, kC = 63;

struct Partials {
  double x, y, c;
};
/// Slopes of functions() in dual_lanes_testing.h.
void closed_forms(double x, double y, double c, Partials* d) {
  const double e = std::exp(x - y), l = std::log(x), s = y < 0.0 ? -1.0 : 1.0;
  const double away = y - x < 0.0 ? -1.0 : 1.0;
  d[0] = {y + c, x, x};
  d[1] = {1 / y, -x / (y * y), -1.0};
  d[2] = {-y, -x, 1.0};
  d[3] = {y, x - c, -y};
  d[4] = {std::sin(y) / (2 * std::sqrt(x)) - c * std::sin(c * x),
          std::sqrt(x) * std::cos(y),
          -x * std::sin(c * x)};
  d[5] = {y / (1 + x * x * y * y), x / (1 + x * x * y * y), 0.0};
  d[6] = {-y / (x * x + y * y), x / (x * x + y * y), 0.0};
  d[7] = {e * l + e / x, -e * l, 0.0};
  d[8] = {(x > y) + (x < c) * 1.0, x > y ? 0.0 : 1.0, x < c ? 0.0 : 1.0};
  d[9] = {-away * s + s, away * s, 0.0};
  d[10] = {x < y ? c : 0.0, x < y ? 0.0 : -1.0, x < y ? x : 0.0};
  d[11] = {0.0, 0.0, 1.0};
}

double slope_at(const SlopeBlock* slopes, int direction, int lane) {
  const std::uint64_t bit = std::uint64_t{1} << direction;
  if (slopes == nullptr || (slopes->directions & bit) == 0) return 0.0;
  return slopes->values()[8 * __builtin_popcountll(slopes->directions & (bit - 1)) + lane];
}

class DualLanesOf : public testing::TestWithParam<KernelSet> {
 protected:
  WithKernelSet with_{GetParam()};
};

TEST_P(DualLanesOf, SlopesAreTheClosedFormsAndValuesThoseOfLanes) {
  const double x[8] = {0.3, 1.7, 2.0, 0.01, 5.0, 0.9, 1.0, 3.0};
  const double y[8] = {0.5, -1.2, 2.5, 3.0, -0.1, 0.8, -2.0, 1.5};
  SlopeArena arena;
  const DualNumber c = DualNumber::variable(1.25, kC, arena);
  const DualNumber of_x = DualNumber::variable(0.0, kX, arena),
                   of_y = DualNumber::variable(0.0, kY, arena);
  double values[kFunctions][8], plain[kFunctions][8];
  const SlopeBlock* slopes[kFunctions];
  LATSCH_KERNEL(evaluate)(x, y, c, of_x.slopes, of_y.slopes, values, plain, slopes);
  for (int lane = 0; lane < 8; ++lane) {
    Partials d[kFunctions];
    closed_forms(x[lane], y[lane], c.v, d);
    for (int i = 0; i < kFunctions; ++i) {
      EXPECT_EQ(values[i][lane], plain[i][lane]) << i;
      const double reach = 1e-14 * (1.0 + std::abs(d[i].x) + std::abs(d[i].y) + std::abs(d[i].c));
      EXPECT_NEAR(slope_at(slopes[i], kX, lane), d[i].x, reach) << i << " " << lane;
      EXPECT_NEAR(slope_at(slopes[i], kY, lane), d[i].y, reach) << i << " " << lane;
      EXPECT_NEAR(slope_at(slopes[i], kC, lane), d[i].c, reach) << i << " " << lane;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(DualLanes,
                         DualLanesOf,
                         testing::ValuesIn(kernel_sets()),
                         [](const auto& info) { return std::string(name(info.param)); });

TEST(DualNumber, SlopesAreTheClosedForms) {
  SlopeArena arena;
  const DualNumber x = DualNumber::variable(0.7, kX, arena),
                   y = DualNumber::variable(2.5, kY, arena);
  const auto near = [&](const DualNumber& f, double value, double by_x, double by_y) {
    EXPECT_NEAR(f.v, value, 1e-14);
    EXPECT_NEAR(f.slope(kX), by_x, 1e-14 * (1.0 + std::abs(by_x)));
    EXPECT_NEAR(f.slope(kY), by_y, 1e-14 * (1.0 + std::abs(by_y)));
  };
  near(x * y - 3.0 * x, -0.35, -0.5, 0.7);
  near(1.0 / (x + y), 1.0 / 3.2, -1.0 / 10.24, -1.0 / 10.24);
  near(pow(x, y), std::pow(0.7, 2.5), 2.5 * std::pow(0.7, 1.5), std::pow(0.7, 2.5) * std::log(0.7));
  near(tan(x), std::tan(0.7), 1.0 / (std::cos(0.7) * std::cos(0.7)), 0.0);
  near(log10(y), std::log10(2.5), 0.0, 1.0 / (2.5 * std::log(10.0)));
  near(sqrt(y) * abs(-x), std::sqrt(2.5) * 0.7, std::sqrt(2.5), 0.7 * 0.5 / std::sqrt(2.5));
  near(sqrt(x - 0.7), 0.0, 0.0, 0.0);  // convention
  EXPECT_EQ(DualNumber(3.0).slopes, nullptr);
}

TEST(SlopeArena, WhatIsGivenBackIsUsedAgainAndChunksDoNotOverlap) {
  SlopeArena arena;
  const SlopeBlock* kept = DualNumber::variable(1.0, 3, arena).slopes;
  const auto start = arena.mark();
  SlopeBlock* first = arena.make(~std::uint64_t{0}, 8);
  for (int i = 0; i < 1000; ++i) {
    SlopeBlock* more = arena.make(~std::uint64_t{0}, 8);
    for (int j = 0; j < 64 * 8; ++j) more->values()[j] = i;
  }
  EXPECT_EQ(kept->values()[0], 1.0);
  arena.rewind(start);
  EXPECT_EQ(arena.make(~std::uint64_t{0}, 8), first);
}

}  // namespace
}  // namespace latsch::dual_lanes_testing
