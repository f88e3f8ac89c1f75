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

// The footprint is 10 mm long and wide and lies inside the sensor, which therefore measures its
// whole force.
TEST(Footprint, APatchSmallerThanTheSensorCountsWithItsForce) {
  const Footprint print = Footprint::rectangle(20.0, 0.01, 0.01);
  EXPECT_NEAR(print.peak_pressure(kSide), 20.0 / (kSide * kSide), 1e-6);
}

// The reference value is the maximum over sensor positions a tenth of a millimeter apart.
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
    EXPECT_LE(peak, most * 1.01);  // the reference, too, is searched in finite steps
    EXPECT_GE(peak, most * 0.97);
  }
}

TEST(Footprint, GripIsTheShareOfTheFrictionThatIsUsed) {
  Footprint print;
  EXPECT_EQ(print.grip_level(), 0.0);
  print.elements = {{0, 0, 0.01, 0.01, 4e5, 3e5, 4e5, 1.25},  // slides
                    // This element uses a fifth of its friction.
                    {0.02, 0, 0.03, 0.01, 4e5, 0.0, 1e5, 1.25}};
  EXPECT_NEAR(print.grip_level(), (1.0 + 3.0 * 0.2) / 4.0, 1e-12);
  for (FootprintElement& at : print.elements) at.friction = 0.0;
  EXPECT_EQ(print.grip_level(), 0.0);
}

constexpr double kHat = 10e-3;  // m, distance between nodes

/// Returns the element of a node. Its pressure is the mean pressure weighted by the node's hat
/// function (experiment/rigs/fe_tire/tire_footprint.h).
FootprintElement share(double x, double y, double pressure) {
  return {
      .x = x, .y = y, .length = kHat, .width = kHat, .pressure = pressure, .blur = std::sqrt(0.5)};
}

/// Returns elements at nodes x = offset + k kHat. Their pressure depends on x only.
template <class Pressure>
Footprint strip(double offset, const Pressure& pressure) {
  Footprint print;
  for (int k = -6; k <= 6; ++k) {
    for (int j = -6; j <= 6; ++j) {
      const double x = offset + k * kHat;
      if (pressure(x) > 0.0) print.elements.push_back(share(x, j * kHat, pressure(x)));
    }
  }
  return print;
}

// Neighboring elements overlap such that the sum of their pressures is uniform.
TEST(BlurredFootprint, ASensorOnEvenPressureShowsIt) {
  const Footprint print = strip(0.0, [](double) { return 2e5; });
  for (const double x : {0.0, 1e-3, 4e-3, 7.5e-3})
    EXPECT_NEAR(print.pressure_at(x, -3e-3, kSide), 2e5, 1e-6) << x;
}

TEST(BlurredFootprint, AWideSensorShowsAllOfTheForceOnce) {
  const Footprint print = strip(3e-3, [](double x) { return 1e5 + 1e7 * x; });
  constexpr double kAll = 0.4;
  double force = 0.0;
  for (const FootprintElement& at : print.elements) force += at.pressure * at.area();
  EXPECT_NEAR(print.pressure_at(0.0, 0.0, kAll) * kAll * kAll, force, 1e-9 * force);
}

// The second moment of a single element's force is (L^2 + b^2) / 12. It is found from the forces on
// narrow sensors along the element.
TEST(BlurredFootprint, AShareIsSpreadMidwayBetweenEvenAndHat) {
  Footprint print;
  print.elements.push_back(share(0.0, 0.0, 1e5));
  constexpr double kNarrow = 1e-4;
  double force = 0.0, moment = 0.0;
  for (int k = -200; k <= 200; ++k) {
    const double x = k * kNarrow, here = print.pressure_at(x, 0.0, kNarrow);
    force += here;
    moment += here * x * x;
  }
  EXPECT_NEAR(moment / force, 0.5 * (1.0 / 12.0 + 1.0 / 6.0) * kHat * kHat, 1e-3 * kHat * kHat);
}

/// Elliptic pressure p0 sqrt(1 - (x / a)^2), Pa, of a line contact [Johnson, Contact Mechanics,
/// section 4.2], its mean weighted by a node's hat function, and the pressure that a sensor would
/// measure.
struct Line {
  double a, p0 = 3e5;
  double at(double x) const {
    return std::abs(x) < a ? p0 * std::sqrt(1.0 - x * x / (a * a)) : 0.0;
  }
  template <class Weight>
  double mean(double from, double to, const Weight& weight) const {
    constexpr int kParts = 4000;
    double sum = 0.0, weights = 0.0;
    for (int k = 0; k < kParts; ++k) {
      const double x = from + (to - from) * (k + 0.5) / kParts;
      sum += weight(x) * at(x);
      weights += weight(x);
    }
    return sum / weights;
  }
  double of_node(double x) const {
    return mean(x - kHat, x + kHat, [x](double s) { return 1.0 - std::abs(s - x) / kHat; });
  }
  double of_sensor() const {
    return mean(-0.5 * kSide, 0.5 * kSide, [](double) { return 1.0; });
  }
};

// The weighted mean at a node is lower than the peak of the ellipse: by 9 % if the contact is three
// elements long and by 3 % if it is five, with a node or an element in the middle.
TEST(BlurredFootprint, ASensorShowsThePeakOfALineContact) {
  struct {
    double a, reach;
  } const patches[] = {{16e-3, 0.10}, {25e-3, 0.03}, {40e-3, 0.015}};
  for (const auto& [a, reach] : patches) {
    for (const double offset : {0.0, 0.5 * kHat}) {
      const Line line{a};
      const Footprint print = strip(offset, [&](double x) { return line.of_node(x); });
      const double shown = print.pressure_at(0.0, 0.0, kSide);
      EXPECT_NEAR(shown / line.of_sensor(), 1.0, reach) << a << " " << offset;
      EXPECT_NEAR(print.peak_pressure(kSide), shown, 0.01 * shown) << a << " " << offset;
    }
  }
}

}  // namespace
}  // namespace latsch
