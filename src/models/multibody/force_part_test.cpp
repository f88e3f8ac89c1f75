// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/force_part.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::multibody {
namespace {

const PartMemory kRest;

TEST(ForceCharacteristic, GoesThroughItsPointsRisesWithThemAndIsStraightBeyond) {
  const ForceCharacteristic curve({{-0.02, -900.0}, {-0.01, -200.0}, {0.0, 0.0}, {0.005, 400.0}});
  for (const auto& [x, f] : curve.points()) EXPECT_NEAR(curve.at(x), f, 1e-9);
  for (double x = -0.03; x < 0.01; x += 1e-4) EXPECT_GT(curve.at(x + 1e-4), curve.at(x)) << x;
  EXPECT_NEAR(curve.at(0.015) - curve.at(0.01), 400.0 / 0.005 * 0.005, 1e-9);
  EXPECT_NEAR(curve.at(-0.03) - curve.at(-0.02), -700.0 / 0.01 * 0.01, 1e-9);
}

TEST(ForceCharacteristic, SlopeAndAreaAreThoseOfDifferences) {
  const ForceCharacteristic curve(
      {{-0.02, -900.0}, {-0.01, -200.0}, {0.0, 0.0}, {0.005, 400.0}, {0.02, 500.0}});
  EXPECT_EQ(curve.area(0.0), 0.0);
  const double h = 1e-7;
  for (double x = -0.03; x < 0.03; x += 0.00137) {
    EXPECT_NEAR((curve.at(x + h) - curve.at(x - h)) / (2.0 * h), curve.slope(x), 1e-2) << x;
    EXPECT_NEAR((curve.area(x + h) - curve.area(x - h)) / (2.0 * h), curve.at(x), 1e-4) << x;
  }
}

TEST(ForceCharacteristic, APointOnALineStaysOnTheLine) {
  const ForceCharacteristic curve({{-1.0, -3.0}, {0.5, 1.5}, {2.0, 6.0}});
  for (double x = -2.0; x < 3.0; x += 0.1) EXPECT_NEAR(curve.at(x), 3.0 * x, 1e-12);
}

TEST(ForceCharacteristic, WhatIsNoneIsNamed) {
  EXPECT_NE(ForceCharacteristic::fault({{0.0, 1.0}}).find("1 points"), std::string::npos);
  EXPECT_NE(ForceCharacteristic::fault({{0.0, 1.0}, {0.0, 2.0}}).find("point 2"),
            std::string::npos);
  EXPECT_NE(ForceCharacteristic::fault({{0.0, 1.0}, {NAN, 2.0}}).find("not a number"),
            std::string::npos);
}

/// Returns the static force f at each deflection of a path.
std::vector<double> along(const ForcePart& part, const std::vector<double>& path) {
  PartMemory memory;
  std::vector<double> forces;
  for (const double d : path) {
    const PartForce f = respond(part, d, 0.0, memory, kStatics);
    memory = {f.s, d};
    forces.push_back(f.f);
  }
  return forces;
}

TEST(ForcePart, FrictionSticksThenSlipsAndDrawsALoop) {
  const ForcePart friction = Friction{1e6, 50.0};
  const auto f = along(friction, {2e-5, 4e-5, 1e-3, 0.99e-3, 0.9e-3, -1e-3, 0.0});
  const std::vector<double> expected = {20.0, 40.0, 50.0, 40.0, -50.0, -50.0, 50.0};
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], expected[i], 1e-9) << i;
}

TEST(ForcePart, PlayIsFreeWithinItsGap) {
  const ForcePart play = Play{1e-3, 2e6};
  const auto f = along(play, {0.5e-3, 1e-3, 1.5e-3, -2e-3});
  const std::vector<double> expected = {0.0, 0.0, 1e3, -2e3};
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], expected[i], 1e-9) << i;
}

// The equation s' = k d' - s/T at constant rate v has the solution s = k T v (1 - exp(-t/T)). The
// part must give it in one step as well as in ten.
TEST(ForcePart, AMaxwellPartIsExactAtConstantRateForAnyStep) {
  const ForcePart part = Maxwell{3e5, 0.02};
  const double rate = 0.1, end = 0.03;
  for (const int steps : {1, 10}) {
    PartMemory memory;
    PartForce f;
    for (int i = 1; i <= steps; ++i) {
      const double d = rate * end * i / steps;
      f = respond(part, d, rate, memory, end / steps);
      memory = {f.s, d};
    }
    EXPECT_NEAR(f.f, 3e5 * 0.02 * rate * (1.0 - std::exp(-end / 0.02)), 1e-9);
  }
  EXPECT_EQ(respond(part, 1e-3, 0.0, {5.0, 0.0}, kStatics).f, 0.0);
}

TEST(ForcePart, SlopesAreThoseOfDifferences) {
  const ForceCharacteristic curve({{-0.02, -900.0}, {0.0, 0.0}, {0.005, 400.0}});
  const std::vector<ForcePart> parts = {ElasticCurve{curve},
                                        ViscousCurve{curve},
                                        Play{1e-4, 2e6},
                                        Maxwell{3e5, 0.02},
                                        Friction{1e5, 500.0}};
  const PartMemory memory{12.0, 1e-3};
  const double h = 1e-8, d = 2.3e-3, v = 1.1e-3, step = 1e-3;
  for (const ForcePart& part : parts) {
    const PartForce f = respond(part, d, v, memory, step);
    const double by_d =
        (respond(part, d + h, v, memory, step).f - respond(part, d - h, v, memory, step).f) /
        (2.0 * h);
    const double by_rate =
        (respond(part, d, v + h, memory, step).f - respond(part, d, v - h, memory, step).f) /
        (2.0 * h);
    EXPECT_NEAR(f.by_d, by_d, 1e-3 + 1e-6 * std::abs(by_d)) << part.index();
    EXPECT_NEAR(f.by_rate, by_rate, 1e-3 + 1e-6 * std::abs(by_rate)) << part.index();
  }
}

TEST(ForcePart, NumbersThatMakeNoneAreNamed) {
  EXPECT_NE(fault_of(Maxwell{1.0, 0.0}), "");
  EXPECT_NE(fault_of(Friction{0.0, 1.0}), "");
  EXPECT_NE(fault_of(Play{-1.0, 1.0}), "");
  EXPECT_EQ(fault_of(Play{0.0, 1.0}), "");
}

}  // namespace
}  // namespace latsch::multibody
