// SPDX-License-Identifier: Apache-2.0
#include "models/tire/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace latsch {
namespace {

constexpr double kSide = 15e-3;  // m

TEST(Footprint, ASensorInsideSeesThePressureAndHalfOfItAtTheEdge) {
  const Footprint print = Footprint::rectangle(4000.0, 0.10, 0.16);
  const double p = 4000.0 / 0.016;
  EXPECT_NEAR(print.pressure_at(0.0, 0.01, kSide), p, 1e-9 * p);
  EXPECT_NEAR(print.pressure_at(0.05, 0.0, kSide), 0.5 * p, 1e-9 * p);
  EXPECT_NEAR(print.pressure_at(0.05, -0.08, kSide), 0.25 * p, 1e-9 * p);
  EXPECT_EQ(print.pressure_at(0.06, 0.0, kSide), 0.0);
  EXPECT_NEAR(print.peak_pressure(kSide), p, 1e-9 * p);
}

// On a patch of 10 mm the sensor sees what it holds.
TEST(Footprint, APatchSmallerThanTheSensorCountsWithItsForce) {
  const Footprint print = Footprint::rectangle(20.0, 0.01, 0.01);
  EXPECT_NEAR(print.peak_pressure(kSide), 20.0 / (kSide * kSide), 1e-6);
}

// By looking everywhere, a tenth of a millimeter apart.
TEST(Footprint, ThePeakIsThatOfEveryPlaceOfTheSensor) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int k = 0; k < 5; ++k) {
    Footprint print;
    for (int i = 0; i < 12; ++i)
      print.elements.push_back({.x = 0.06 * any(random) - 0.03,
                                .y = 0.06 * any(random) - 0.03,
                                .length = 4e-3 + 0.02 * any(random),
                                .width = 4e-3 + 0.02 * any(random),
                                .pressure = 1e5 + 5e5 * any(random)});
    double most = 0.0;
    for (double x = -0.06; x < 0.06; x += 1e-4)
      for (double y = -0.06; y < 0.06; y += 1e-4)
        most = std::max(most, print.pressure_at(x, y, kSide));
    const double peak = print.peak_pressure(kSide);
    EXPECT_GE(peak, most * (1.0 - 1e-9));
    EXPECT_LE(peak, most * 1.03);  // steepest from place to place
  }
}

TEST(Footprint, GripIsTheShareOfTheFrictionThatIsUsed) {
  Footprint print;
  EXPECT_EQ(print.grip_level(), 0.0);
  print.elements = {{0, 0, 0.01, 0.01, 4e5, 3e5, 4e5, 1.25},      // slides
                    {0.02, 0, 0.03, 0.01, 4e5, 0.0, 1e5, 1.25}};  // uses a fifth
  EXPECT_NEAR(print.grip_level(), (1.0 + 3.0 * 0.2) / 4.0, 1e-12);
  for (FootprintElement& at : print.elements) at.friction = 0.0;
  EXPECT_EQ(print.grip_level(), 0.0);
}

}  // namespace
}  // namespace latsch
