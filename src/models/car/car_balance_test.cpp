// SPDX-License-Identifier: Apache-2.0
// Tests the balance of a car under air: rigid and compliant joints, downforce of several times its
// weight, drag. The references are sums of forces and moments about a line on the ground.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "models/car/car.h"
#include "models/car/race_car_testing.h"
#include "models/road/plane_road.h"

namespace latsch::car {
namespace {

using Eigen::Vector3d;

constexpr double kArea = 1.2, kDensity = 1.2;

void make_rigid(CarParameters& car) {
  for (Axle* axle : {&car.front, &car.rear})
    for (multibody::BushingParameters& bushing : axle->corner.bushings) {
      bushing = {Vector3d::Constant(1e10), Vector3d::Zero(), Vector3d::Constant(1e6)};
      bushing.rigid = true;
    }
}

void add_bump_stops(CarParameters& car) {
  for (Axle* axle : {&car.front, &car.rear})
    axle->inboard->unit.parts.push_back(multibody::ElasticCurve{multibody::ForceCharacteristic(
        {{-0.040, -12e3}, {-0.030, -2e3}, {-0.025, 0.0}, {0.0, 0.0}, {0.1, 0.0}})});
}

/// Returns a car whose downforce at this speed is `times` its weight, with 45 % of the downforce at
/// the front axle.
CarParameters pressed_car(bool rigid, double speed, double times, double drag = 0.0) {
  CarParameters car = race_car(false);
  if (rigid) make_rigid(car);
  add_bump_stops(car);
  double mass = 0.0;
  const auto built = build(car);
  for (const auto& body : built.mechanism.bodies()) mass += body.mass;
  const double q = 0.5 * kDensity * speed * speed * kArea, all = times * mass * car.gravity / q;
  AeroMap air;
  air.area = kArea;
  air.density = kDensity;
  air.set_rows({{0.0, 0.0, 0.45 * all, 0.55 * all}});
  air.drag = drag;
  air.drag_height = 0.35;
  car.aero = air;
  return car;
}

std::unique_ptr<Car> made(const CarParameters& parameters, const Tires& tires = spring_tires()) {
  EXPECT_EQ(parameters.fault(), "");
  auto car = Car::make(parameters, tires);
  EXPECT_TRUE(car) << (car ? "" : car.failure().reason);
  return std::move(*car);
}

double sum(const std::array<double, kCorners>& forces) {
  double sum = 0.0;
  for (const double force : forces) sum += force;
  return sum;
}

struct Pressed {
  bool rigid;
  double speed, times;
};

class CarUnderDownforce : public testing::TestWithParam<Pressed> {};

TEST_P(CarUnderDownforce, StandsWithItsWeightAndDownforce) {
  const auto [rigid, speed, times] = GetParam();
  const auto car = made(pressed_car(rigid, speed, times));
  const auto state = car->settle(road::PlaneRoad{}, speed, {});
  ASSERT_TRUE(state) << state.failure().reason;
  const double weight = car->mechanism().mass() * car->parameters().gravity;
  EXPECT_NEAR(
      sum(car->vertical_forces(*state)), weight * (1.0 + times), 1e-6 * weight * (1.0 + times));
}

INSTANTIATE_TEST_SUITE_P(Cars,
                         CarUnderDownforce,
                         testing::Values(Pressed{true, 20.0, 1.0},
                                         Pressed{true, 60.0, 2.0},
                                         Pressed{true, 60.0, 5.0},
                                         Pressed{true, 90.0, 4.0},
                                         Pressed{false, 60.0, 5.0}));

// The forces on a level road do not depend on the lateral position of the car's line, so they equal
// those on the line y = 0. A coordinate of 50 m is rounded to 7e-15 m, which joints of 1e10 N/m
// turn into a force of 7e-5 N. This force is rounding, not an imbalance.
TEST(CarBalance, RigidJointsStandOnEveryLineThatATestMayHave) {
  const auto car = made(pressed_car(true, 60.0, 2.0));
  const auto middle = car->settle(road::PlaneRoad{}, 60.0, {});
  ASSERT_TRUE(middle) << middle.failure().reason;
  const auto expected = car->vertical_forces(*middle);
  for (const double line : {-50.0, -20.0, 10.0, 16.5, 50.0}) {
    CarInputs inputs;
    inputs.guide = GuidePoint{0.0, 60.0, line};
    const auto state = car->settle(road::PlaneRoad{}, 60.0, inputs);
    ASSERT_TRUE(state) << line << " m: " << state.failure().reason;
    const auto forces = car->vertical_forces(*state);
    for (std::size_t i = 0; i < kCorners; ++i)
      EXPECT_NEAR(forces[i], expected[i], 1e-4 * expected[i]) << line << " m, tire " << i;
  }
}

// The load acts on one front corner only, so the solver starts from a state far from the final
// equilibrium.
TEST(CarBalance, ALargeLoadOnOneCornerOfRigidJointsFindsRest) {
  CarParameters parameters = race_car(false);
  make_rigid(parameters);
  add_bump_stops(parameters);
  const auto car = made(parameters);
  for (const double load : {2e3, 8e3, 14e3}) {
    CarInputs inputs;
    inputs.loads = {{car->parts().chassis, {1.55, 0.3, 0.3}, {0.0, 0.0, -load}}};
    const auto state = car->settle(road::PlaneRoad{}, 0.0, inputs);
    ASSERT_TRUE(state) << load << ": " << state.failure().reason;
    const double down = car->mechanism().mass() * parameters.gravity + load;
    EXPECT_NEAR(sum(car->vertical_forces(*state)), down, 1e-6 * down);
  }
}

/// Returns why a car at 60 m/s finds no rest if the coefficients of downforce are `low`, `middle`
/// and 0.25 for floors of an axle at -0.4, 0.04 and 0.05 m; those of both axles add up. The car is
/// drawn with both floors at 0.05 m.
std::string sinking(bool rigid, double low, double middle) {
  CarParameters parameters = pressed_car(rigid, 60.0, 1.0);
  AeroMap& air = *parameters.aero;
  air.floor_front = air.floor_rear = 0.05;
  const std::array<std::array<double, 2>, 3> heights = {
      {{-0.4, low}, {0.04, middle}, {0.05, 0.25}}};
  std::vector<AeroMap::Row> rows;
  for (const auto& [front, of_front] : heights)
    for (const auto& [rear, of_rear] : heights)
      rows.push_back({front, rear, of_front + of_rear, of_front + of_rear});
  air.set_rows(rows);
  for (Axle* axle : {&parameters.front, &parameters.rear}) axle->inboard->unit.parts.clear();
  const auto car = made(parameters);
  const auto state = car->settle(road::PlaneRoad{}, 60.0, {});
  EXPECT_FALSE(state);
  return state ? "" : state.failure().reason;
}

// The lower the floor, the larger is the downforce, which acts as a negative spring. It is stronger
// than the springs of the car below 40 mm, or already at the height at which the car is drawn.
TEST(CarBalance, WhatSinksIsToldInWords) {
  for (const bool rigid : {true, false}) {
    const std::string sunk = sinking(rigid, 30.0, 0.3);
    for (const char* part : {"of the load",
                             "had sunk most at",
                             "spring unit shortened by",
                             "the downforce would be",
                             "times the weight"})
      EXPECT_NE(sunk.find(part), std::string::npos) << sunk;
    const std::string unstable = sinking(rigid, 30.0, 0.92);
    for (const char* part : {"not even a small share of the load", "with every millimeter"})
      EXPECT_NE(unstable.find(part), std::string::npos) << unstable;
  }
}

/// Returns the imbalance of moments about the y axis on the ground, N m: drag at its height, weight
/// and downforce at the current positions of bodies and points, minus the tire forces.
double pitch_left(const Car& car, const CarState& state, double speed) {
  const CarParameters& of = car.parameters();
  const auto& bodies = car.mechanism().bodies();
  double moment = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    moment += bodies[i].mass * of.gravity * state.bodies.poses[i].place.x();
  const double q = 0.5 * of.aero->density * speed * speed * of.aero->area;
  const auto c = of.aero->at(0.0, 0.0);
  const auto at = [&](double x, double z) {
    return car.point(state, car.parts().chassis, {x, 0.0, z});
  };
  moment += q * c.downforce[0] * at(of.front.corner.wheel_center.x(), of.aero->floor_front).x();
  moment += q * c.downforce[1] * at(of.rear.corner.wheel_center.x(), of.aero->floor_rear).x();
  moment -= q * of.aero->drag * at(bodies[0].origin.x(), of.aero->drag_height).z();
  const auto Fz = car.vertical_forces(state);
  for (std::size_t i = 0; i < kCorners; ++i) moment -= Fz[i] * state.wheels[i].motion.center.x();
  return moment;
}

// The tires of the driven axle bear the drag at their contact points on the ground. Moments about a
// line on the ground therefore come only from weight, air and vertical forces, whichever axle
// drives.
TEST(CarBalance, DragShiftsLoadsAsAnAxleThatDrivesDoes) {
  for (const std::array<double, 2> drives :
       {std::array{0.0, 1.0}, std::array{1.0, 0.0}, std::array{0.5, 0.5}})
    for (const bool rigid : {true, false}) {
      const auto car = made(pressed_car(rigid, 60.0, 1.0, 1.1));
      car->guide.drives = drives;
      const auto state = car->settle(road::PlaneRoad{}, 60.0, {});
      ASSERT_TRUE(state) << state.failure().reason;
      const double drag = 0.5 * kDensity * 60.0 * 60.0 * kArea * 1.1;
      EXPECT_NEAR(pitch_left(*car, *state, 60.0), 0.0, 1e-5 * drag * 0.35) << drives[0];
      EXPECT_NEAR(state->trim.along, drag, 1e-6 * drag);
      // A drag of 2851 N at the height of 0.33 m that its point has at speed, over a wheelbase of
      // 1.55 m, shifts 605 N from the front to the rear axle. The car's pitch changes this
      // slightly.
      const auto still = made(pressed_car(rigid, 60.0, 1.0, 0.0));
      const auto without = still->settle(road::PlaneRoad{}, 60.0, {});
      const auto a = car->vertical_forces(*state), b = still->vertical_forces(*without);
      const double height = car->point(*state, car->parts().chassis, {0.75, 0.0, 0.35}).z();
      EXPECT_NEAR(
          a[kRL] + a[kRR] - b[kRL] - b[kRR], drag * height / 1.55, 0.03 * drag * height / 1.55);
    }
}

/// A spring tire whose radius grows by 2 mm when it rolls.
class GrowingTire final : public Tire {
 public:
  double free_radius() const override { return still_.free_radius(); }
  Result<HubForces> settle(const WheelMotion& motion,
                           const road::Road& road,
                           double time) override {
    return still_.settle(motion, road, time);
  }
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override {
    return grown_.advance(motion, road, time, step);
  }
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    return advance_by_trials(*this, motion, wheel, road, time, step);
  }
  std::unique_ptr<Tire> clone() const override { return std::make_unique<GrowingTire>(*this); }

 private:
  SpringTire still_{{0.235, 117e3, 300.0}}, grown_{{0.237, 117e3, 300.0}};
};

// The arm of the pull against drag is the height of the wheel centers at speed, not at rest: with
// that of tires at rest the moment would be off by 2 mm times the drag.
TEST(CarBalance, DragActsOnTheGroundAlsoOnTiresThatGrowAtSpeed) {
  Tires tires;
  for (auto& tire : tires) tire = std::make_unique<GrowingTire>();
  for (const bool rigid : {true, false}) {
    const auto car = made(pressed_car(rigid, 60.0, 1.0, 1.1), tires);
    const auto state = car->settle(road::PlaneRoad{}, 60.0, {});
    ASSERT_TRUE(state) << state.failure().reason;
    const double drag = 0.5 * kDensity * 60.0 * 60.0 * kArea * 1.1;
    EXPECT_NEAR(pitch_left(*car, *state, 60.0), 0.0, 1e-5 * drag * 0.35);
  }
}

TEST(CarBalance, WithDragItStartsInBalanceAndKeepsItsSpeed) {
  for (const double speed : {20.0, 60.0, 90.0})
    for (const bool rigid : {true, false}) {
      const auto car = made(pressed_car(rigid, speed, 2.0, 1.1));
      auto state = car->settle(road::PlaneRoad{}, speed, {});
      ASSERT_TRUE(state) << state.failure().reason;
      EXPECT_NEAR(state->bodies.accelerations[0], 0.0, 1e-4);
      double off = 0.0;
      while (state->time() < 0.5) {
        ASSERT_TRUE(car->advance(*state, 2e-4, road::PlaneRoad{}, {}).ok());
        off = std::max(off, std::abs(state->bodies.rates[0] - speed));
      }
      EXPECT_LT(off, 1e-3) << speed;
    }
}

// If the guide has no longitudinal stiffness, nothing drives the car, and drag slows it down.
TEST(CarBalance, WithoutAGuideDragSlowsItDown) {
  const auto car = made(pressed_car(false, 60.0, 1.0, 1.1));
  auto state = car->settle(road::PlaneRoad{}, 60.0, {});
  ASSERT_TRUE(state) << state.failure().reason;
  car->guide.along = 0.0;
  while (state->time() < 0.1) ASSERT_TRUE(car->advance(*state, 2e-4, road::PlaneRoad{}, {}).ok());
  // The equation of motion v' = -c v² has the solution v0 / (1 + c v0 t).
  const double c = 0.5 * kDensity * kArea * 1.1 / car->mechanism().mass();
  EXPECT_NEAR(state->bodies.rates[0], 60.0 / (1.0 + c * 60.0 * state->time()), 0.01);
}

}  // namespace
}  // namespace latsch::car
