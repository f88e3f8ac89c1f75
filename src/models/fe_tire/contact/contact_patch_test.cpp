// SPDX-License-Identifier: Apache-2.0
// What a sensor shows of pressures at nodes, against closed forms.
#include "models/fe_tire/contact/contact_patch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace latsch::fe_tire {
namespace {

constexpr double kHat = 10e-3;   // m, from node to node
constexpr double kSide = 15e-3;  // m, of the sensor

/// Nodes at offset + k kHat along x, of a pressure that is the same across.
template <class Pressure>
ContactPatch strip(double offset, const Pressure& pressure) {
  ContactPatch patch;
  for (int k = -6; k <= 6; ++k) {
    for (int j = -6; j <= 6; ++j) {
      const double x = offset + k * kHat;
      if (pressure(x) > 0.0)
        patch.points.push_back({x, j * kHat, pressure(x), 0.0, 0.0, kHat * kHat, kHat, true});
    }
  }
  return patch;
}

// Shares overlap with their neighbors' so that the sum is as it was.
TEST(ContactPatch, ASensorOnEvenPressureShowsIt) {
  const ContactPatch patch = strip(0.0, [](double) { return 2e5; });
  for (const double x : {0.0, 1e-3, 4e-3, 7.5e-3})
    EXPECT_NEAR(patch.mean_pressure(x, -3e-3, kSide), 2e5, 1e-6) << x;
}

TEST(ContactPatch, AWideSensorShowsAllOfTheForceOnce) {
  const ContactPatch patch = strip(3e-3, [](double x) { return 1e5 + 1e7 * x; });
  constexpr double kAll = 0.4;
  double force = 0.0;
  for (const ContactPatch::Point& point : patch.points) force += point.pressure * point.area;
  EXPECT_NEAR(patch.mean_pressure(0.0, 0.0, kAll) * kAll * kAll, force, 1e-9 * force);
}

// Of one share alone the second moment is what (P.1) says: forces on narrow sensors along it.
TEST(ContactPatch, AShareIsSpreadMidwayBetweenEvenAndHat) {
  ContactPatch patch;
  patch.points.push_back({0.0, 0.0, 1e5, 0.0, 0.0, kHat * kHat, kHat, true});
  constexpr double kNarrow = 1e-4;
  double force = 0.0, moment = 0.0;
  for (int k = -200; k <= 200; ++k) {
    const double x = k * kNarrow, here = patch.mean_pressure(x, 0.0, kNarrow);
    force += here;
    moment += here * x * x;
  }
  EXPECT_NEAR(moment / force, 0.5 * (1.0 / 12.0 + 1.0 / 6.0) * kHat * kHat, 1e-3 * kHat * kHat);
}

/// Of an ellipse p0 sqrt(1 - (x / a)^2) [Johnson, Contact Mechanics, section 4.2], Pa: what a node
/// knows of it, weighted by its hat, and what a sensor would show.
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

// A node's mean is lower than the ellipse's peak, the less the longer the patch: by 9 % of three
// elements, by 3 % of five, with a node in the middle or an element.
TEST(ContactPatch, ASensorShowsThePeakOfALineContact) {
  struct {
    double a, reach;
  } const patches[] = {{16e-3, 0.10}, {25e-3, 0.03}, {40e-3, 0.015}};
  for (const auto& [a, reach] : patches) {
    for (const double offset : {0.0, 0.5 * kHat}) {
      const Line line{a};
      const ContactPatch patch = strip(offset, [&](double x) { return line.of_node(x); });
      const double shown = patch.mean_pressure(0.0, 0.0, kSide);
      EXPECT_NEAR(shown / line.of_sensor(), 1.0, reach) << a << " " << offset;
      EXPECT_NEAR(patch.peak_pressure(kSide), shown, 0.01 * shown) << a << " " << offset;
    }
  }
}

}  // namespace
}  // namespace latsch::fe_tire
