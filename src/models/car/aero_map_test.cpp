// SPDX-License-Identifier: Apache-2.0
// Tests the aerodynamic coefficients as functions of ride heights, and a car that reaches
// equilibrium under the resulting downforce.
#include "models/car/aero_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/car/race_car_testing.h"
#include "models/car/smooth_kerb_testing.h"
#include "models/road/plane_road.h"

namespace latsch::car {
namespace {

using Eigen::Vector2d;

/// A bilinear map represents these coefficients exactly:
///   C_f = 1 + 20 (30 mm - h_f) + 4 h_r,   C_r = 1.4 + 10 (40 mm - h_r) - 3 h_f + 50 h_f h_r
Vector2d coefficients(double f, double r) {
  return {1.0 + 20.0 * (0.03 - f) + 4.0 * r, 1.4 + 10.0 * (0.04 - r) - 3.0 * f + 50.0 * f * r};
}

std::vector<AeroMap::Row> rows() {
  std::vector<AeroMap::Row> rows;
  for (const double r : {0.05, 0.01, 0.03})
    for (const double f : {0.0, 0.02, 0.05}) {
      const Vector2d c = coefficients(f, r);
      rows.push_back({f, r, c[0], c[1]});
    }
  return rows;
}

AeroMap map() {
  AeroMap map;
  map.set_rows(rows());
  return map;
}

TEST(AeroMap, IsExactForBilinearCoefficientsAndTheirSlopes) {
  const AeroMap air = map();
  for (const double f : {0.0, 0.013, 0.02, 0.041})
    for (const double r : {0.012, 0.03, 0.05}) {
      const auto c = air.at(f, r);
      EXPECT_LT((c.downforce - coefficients(f, r)).norm(), 1e-12) << f << ' ' << r;
      const double h = 1e-5;
      if (f > 0.0 && f != 0.02) {
        EXPECT_LT((c.by_height.col(0) -
                   (air.at(f + h, r).downforce - air.at(f - h, r).downforce) / (2.0 * h))
                      .norm(),
                  1e-8);
      }
    }
}

TEST(AeroMap, StaysBeyondItsHeights) {
  const AeroMap air = map();
  const auto low = air.at(-0.01, 0.03), high = air.at(0.2, 0.03);
  EXPECT_LT((low.downforce - coefficients(0.0, 0.03)).norm(), 1e-12);
  EXPECT_LT((high.downforce - coefficients(0.05, 0.03)).norm(), 1e-12);
  EXPECT_EQ(low.by_height.col(0).norm(), 0.0);
  EXPECT_EQ(high.by_height.col(0).norm(), 0.0);
}

TEST(AeroMap, GridsWithHolesAndDoublesAreNamed) {
  auto holes = rows();
  holes.pop_back();
  EXPECT_NE(AeroMap::fault(holes).find("has no row of the heights 0.05 m and 0.03 m"),
            std::string::npos)
      << AeroMap::fault(holes);
  holes.push_back(holes.front());
  EXPECT_NE(AeroMap::fault(holes).find("two rows"), std::string::npos);
  EXPECT_NE(AeroMap::fault({}), "");
}

/// A car at rest, or at constant speed, on level ground: tire loads (N) and ride heights (m).
struct Standing {
  Eigen::Array4d Fz;
  double front_height, rear_height;
};

Standing stand(const CarParameters& parameters, double speed) {
  auto car = Car::make(parameters, spring_tires());
  EXPECT_TRUE(car);
  const auto state = (*car)->settle(road::PlaneRoad{}, speed, {});
  EXPECT_TRUE(state) << state.failure().reason;
  const auto Fz = (*car)->vertical_forces(*state);
  const AeroMap& air = *parameters.aero;
  const double x_f = parameters.front.corner.wheel_center.x(),
               x_r = parameters.rear.corner.wheel_center.x();
  const auto height = [&](double x, double floor) {
    return (*car)->point(*state, (*car)->parts().chassis, {x, 0.0, floor}).z();
  };
  return {{Fz[kFL], Fz[kFR], Fz[kRL], Fz[kRR]},
          height(x_f, air.floor_front),
          height(x_r, air.floor_rear)};
}

TEST(AeroMap, ACarAtSpeedCarriesWhatTheMapSaysOfTheHeightsItIsAt) {
  CarParameters car = race_car(false);
  car.aero = map();
  car.aero->area = 1.3;
  car.aero->floor_front = 0.030;
  car.aero->floor_rear = 0.040;
  const Standing still = stand(car, 0.0), fast = stand(car, 40.0);
  const double qA = 0.5 * 1.2 * 40.0 * 40.0 * 1.3;
  const Vector2d c = coefficients(fast.front_height, fast.rear_height);
  const Eigen::Array4d more = fast.Fz - still.Fz;
  EXPECT_LT(fast.front_height, still.front_height - 1e-3);  // the downforce presses the car down
  // The static equilibrium leaves at most 1e-5 of the weight at each tire.
  EXPECT_NEAR(more[kFL] + more[kFR], qA * c[0], 1e-3 * qA);
  EXPECT_NEAR(more[kRL] + more[kRR], qA * c[1], 1e-3 * qA);
}

TEST(AeroMap, StepsWithItAreOfSecondOrder) {
  CarParameters parameters = race_car(false);
  parameters.aero = map();
  parameters.aero->area = 2.0;
  parameters.aero->drag = 1.1;
  parameters.aero->drag_height = 0.4;
  parameters.aero->floor_front = 0.035;
  parameters.aero->floor_rear = 0.045;
  // While the wheels roll over the kerb, the floor rises and falls by less than a cell of the map.
  const auto height_over_kerb = [&](double h) {
    auto car = Car::make(parameters, spring_tires());
    const SmoothKerb road;
    auto state = (*car)->settle(road, 40.0, {});
    for (int i = 0; i < std::lround(0.08 / h); ++i)
      EXPECT_TRUE((*car)->advance(*state, h, road, {}).ok());
    return state->bodies.poses[0].place.z();
  };
  const double a = height_over_kerb(1e-4), b = height_over_kerb(5e-5), c = height_over_kerb(2.5e-5);
  EXPECT_NEAR((a - b) / (b - c), 4.0, 0.4);
}

}  // namespace
}  // namespace latsch::car
