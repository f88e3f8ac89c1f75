// SPDX-License-Identifier: Apache-2.0
// Tests the car at rest and on a kerb: weight, symmetry, order of convergence of its steps, and
// states that are copied and restored.
#include "models/car/car.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/car/aero_loaders.h"
#include "models/car/race_car_testing.h"
#include "models/car/smooth_kerb_testing.h"
#include "models/car/spring_tire.h"
#include "models/road/placed_road.h"
#include "models/road/plane_road.h"
#include "models/road/triangle_road.h"

namespace latsch::car {
namespace {

using Eigen::Vector3d;

std::unique_ptr<Car> made(const CarParameters& parameters) {
  EXPECT_EQ(parameters.fault(), "");
  auto car = Car::make(parameters, spring_tires());
  EXPECT_TRUE(car) << (car ? "" : car.failure().reason);
  return std::move(*car);
}

TEST(Car, AtRestCarriesItsWeightByItsLevers) {
  for (const bool locked : {true, false}) {
    const auto car = made(race_car(locked));
    const auto state = car->settle(road::PlaneRoad{}, 0.0, {});
    ASSERT_TRUE(state) << state.failure().reason;
    const auto Fz = car->vertical_forces(*state);
    double moment = 0.0, mass = 0.0;
    for (const auto& body : car->mechanism().bodies()) {
      mass += body.mass;
      moment += body.mass * body.origin.x();
    }
    const double weight = mass * 9.80665, front = weight * moment / mass / 1.55;
    EXPECT_NEAR(Fz[kFL] + Fz[kFR], front, 2e-3 * weight);
    EXPECT_NEAR(Fz[kFL] + Fz[kFR] + Fz[kRL] + Fz[kRR], weight, 1e-4 * weight);
    EXPECT_NEAR(Fz[kFL], Fz[kFR], 1e-4 * weight);
    EXPECT_NEAR(Fz[kRL], Fz[kRR], 1e-4 * weight);
    // The car stands as drawn, but lower by the deflection of its tires, and its chassis is level.
    const auto& chassis = state->bodies.poses[0];
    EXPECT_NEAR(chassis.place.x(), 0.75, 1e-3);
    EXPECT_LT((chassis.turn - Eigen::Matrix3d::Identity()).norm(), 5e-3);
  }
}

std::vector<double> pushrod_over_kerb(double h, bool locked) {
  const auto car = made(race_car(locked));
  const SmoothKerb road;
  auto state = car->settle(road, 20.0, {});
  EXPECT_TRUE(state) << state.failure().reason;
  std::vector<double> forces;
  const int each = static_cast<int>(std::lround(1e-3 / h));
  for (int i = 0; i < 250 * each; ++i) {
    const auto done = car->advance(*state, h, road, {});
    EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.failure().reason);
    if (!done) break;
    if (i % each == each - 1) forces.push_back(car->pushrod_forces(*state)[kFL]);
  }
  return forces;
}

double rms_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(a[i] - b[i], 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(Car, OverAKerbItsPushrodForcesAreOfOrderTwo) {
  for (const bool locked : {true, false}) {
    const auto a = pushrod_over_kerb(1e-4, locked), b = pushrod_over_kerb(5e-5, locked),
               c = pushrod_over_kerb(2.5e-5, locked);
    EXPECT_GT(rms_between(a, b) / rms_between(b, c), 3.6) << locked;
    EXPECT_LT(rms_between(a, b) / rms_between(b, c), 4.4) << locked;
    const std::vector<double> still(c.size(), c.front());
    EXPECT_LT(rms_between(a, c) / rms_between(c, still), 0.003) << locked;
  }
}

/// Returns a road that is level from x = -2 to 5 m, y = -1 to 1 m.
road::TriangleRoad short_road() {
  return road::TriangleRoad(
      {.nodes = {{-2.0, -1.0, 0.0}, {5.0, -1.0, 0.0}, {5.0, 1.0, 0.0}, {-2.0, 1.0, 0.0}},
       .triangles = {{{0, 1, 2}}, {{0, 2, 3}}}});
}

// The front wheels start at x = 1.55 m, so they reach the end of the road after 3.45 m.
TEST(Car, ATireOffTheRoadsEdgeIsNamedWhenItLeaves) {
  const auto car = made(race_car(true));
  const auto road = short_road();
  constexpr double kSpeed = 20.0, kStep = 5e-4;
  auto state = car->settle(road, kSpeed, {});
  ASSERT_TRUE(state) << state.failure().reason;
  const CarState start = *state;
  std::string why;
  while (why.empty() && state->time() < 0.3)
    if (const auto done = car->advance(*state, kStep, road, {}); !done) why = done.failure().reason;
  EXPECT_NE(why.find("tire F"), std::string::npos) << why;
  EXPECT_NE(why.find("off the road's edge"), std::string::npos);
  EXPECT_NE(why.find("x = -2 and 5 m"), std::string::npos);
  EXPECT_NEAR(state->time(), (5.0 - start.wheels[kFL].motion.center.x()) / kSpeed, 4.0 * kStep);

  car->may_leave_road = true;
  *state = start;
  while (state->time() < 0.3) ASSERT_TRUE(car->advance(*state, kStep, road, {}).ok());
}

TEST(Car, ACarThatIsDrawnBesideItsRoadIsRefused) {
  const auto car = made(race_car(true));
  const auto state = car->settle(
      road::PlacedRoad(
          std::make_shared<const road::TriangleRoad>(short_road()), 0.0, {0.0, 1.3, 0.0}),
      20.0,
      {});
  ASSERT_FALSE(state);
  EXPECT_NE(state.failure().reason.find("tire FR is off the road's edge"), std::string::npos)
      << state.failure().reason;
}

TEST(Car, ATwistedChassisIsASpringAboutItsAxis) {
  CarParameters parameters = race_car(true);
  parameters.gravity = 0.0;
  const double k = 2e5;
  parameters.chassis.torsion = Chassis::Torsion{k, 0.0, 0.75, 0.28};
  ASSERT_EQ(parameters.fault(), "");
  const CarMechanism car = build(parameters);
  const auto& bodies = car.mechanism.bodies();
  // The two halves of the chassis together have the mass and inertia of the undivided chassis.
  const multibody::BodyMass both =
      multibody::together({bodies[0].mass, bodies[0].origin, bodies[0].inertia},
                          {bodies[1].mass, bodies[1].origin, bodies[1].inertia});
  EXPECT_NEAR(both.mass, 180.0, 1e-12);
  EXPECT_LT((both.center - Vector3d(0.75, 0.0, 0.28)).norm(), 1e-12);
  EXPECT_LT((both.inertia - parameters.chassis.body.inertia).norm(), 1e-10);
  // The rear half of the chassis is held while a moment twists the front half.
  auto joints = car.mechanism.joints();
  joints.push_back({"rig",
                    multibody::kGround,
                    car.parts.chassis_rear,
                    bodies[1].origin,
                    {Vector3d::Constant(1e12), Vector3d::Constant(1e12)}});
  const multibody::Mechanism held(bodies, joints, {}, kDrivers);
  const multibody::Load twist{0, bodies[0].origin, Vector3d::Zero(), {500.0, 0.0, 0.0}};
  const auto poses = multibody::Equilibrium(held).solve({&twist, 1});
  ASSERT_TRUE(poses) << poses.failure().reason;
  const auto& turn = (*poses)[0].turn;
  EXPECT_NEAR(std::atan2(turn(2, 1), turn(2, 2)), 500.0 / k, 1e-5 * 500.0 / k);
}

TEST(Car, AnAntiRollBarResistsRollAndNothingElse) {
  CarParameters soft = race_car(false), barred = soft;
  barred.front.inboard->bar =
      Inboard::AntiRollBar{{1.473721, 0.117534, 0.586859}, {1.523023, 0.124672, 0.582738}, 8e4};
  const auto roll_and_heave = [](const CarParameters& parameters) {
    const auto car = made(parameters);
    const auto still = *car->settle(road::PlaneRoad{}, 0.0, {});
    CarInputs rolled, pressed;
    rolled.loads = {{0, {0.75, 0.0, 0.28}, Vector3d::Zero(), {300.0, 0.0, 0.0}}};
    pressed.loads = {{0, {0.75, 0.0, 0.28}, {0.0, 0.0, -500.0}, Vector3d::Zero()}};
    const auto leaning = car->settle(road::PlaneRoad{}, 0.0, rolled);
    EXPECT_TRUE(leaning) << (leaning ? "" : leaning.failure().reason);
    const Eigen::Matrix3d turn = leaning->bodies.poses[0].turn;
    const double heave = car->settle(road::PlaneRoad{}, 0.0, pressed)->bodies.poses[0].place.z() -
                         still.bodies.poses[0].place.z();
    return std::pair{std::atan2(turn(2, 1), turn(2, 2)), heave};
  };
  const auto [roll, heave] = roll_and_heave(soft);
  const auto [less_roll, same_heave] = roll_and_heave(barred);
  EXPECT_LT(less_roll, 0.9 * roll);
  EXPECT_GT(less_roll, 0.0);
  EXPECT_NEAR(same_heave, heave, 2e-3 * std::abs(heave));
}

TEST(Car, LoadersAreFoundFromTheForcesOfThePushrods) {
  const auto car = made(race_car(false));
  AeroLoaders loaders;
  loaders.points << 1.55, 1.55, 0.0, 0.4, -0.4, 0.0, 0.3, 0.3, 0.3;
  const Vector3d truth(400.0, 700.0, 1500.0);
  CarInputs with;
  with.loads = loaders.loads(*car, truth);
  const auto pushrods = car->pushrod_forces(*car->settle(road::PlaneRoad{}, 0.0, with));
  Eigen::Vector4d measured(pushrods[0], pushrods[1], pushrods[2], pushrods[3]);
  auto found = solve_loaders(*car, loaders, measured, road::PlaneRoad{}, 0.0);
  ASSERT_TRUE(found) << found.failure().reason;
  EXPECT_LT((found->downforce - truth).norm(), 0.5);
  EXPECT_LT(found->left.norm(), 1.0);
  // A combination of push-rod forces that the loaders cannot produce was added to the measurement.
  // The solution reports it as its remainder.
  measured += 100.0 * found->unreachable;
  found = solve_loaders(*car, loaders, measured, road::PlaneRoad{}, 0.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->left.norm(), 100.0, 1.0);
  EXPECT_LT((found->downforce - truth).norm(), 5.0);
}

/// A spring tire that refuses to stand under loads within a band about a given one, N.
class ChoosyTire final : public Tire {
 public:
  ChoosyTire(double refused, double band)
      : spring_({0.235, 117e3, 300.0}), refused_(refused), band_(band) {}
  double free_radius() const override { return spring_.free_radius(); }
  Result<HubForces> settle(const WheelMotion& motion,
                           const road::Road& road,
                           double time) override {
    auto hub = spring_.settle(motion, road, time);
    if (hub && std::abs(hub->force.z() - refused_) < band_)
      return Failure{"the tire refuses this load"};
    return hub;
  }
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override {
    return spring_.advance(motion, road, time, step);
  }
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    return advance_by_trials(*this, motion, wheel, road, time, step);
  }
  std::unique_ptr<Tire> clone() const override { return std::make_unique<ChoosyTire>(*this); }

 private:
  SpringTire spring_;
  double refused_, band_;
};

// The wanted push-rod forces need downforce under which the car has no equilibrium, though it has
// one beside it. Every step is halved there, and the message says why, not only what is left.
TEST(Car, LoadersThatTheCarCannotBearAreRefusedWithTheCause) {
  AeroLoaders loaders;
  loaders.points << 1.55, 1.55, 0.0, 0.4, -0.4, 0.0, 0.3, 0.3, 0.3;
  const auto content = made(race_car(false));
  CarInputs with;
  with.loads = loaders.loads(*content, {400.0, 700.0, 1500.0});
  const CarState pressed = *content->settle(road::PlaneRoad{}, 0.0, with);
  const auto pushrods = content->pushrod_forces(pressed);
  const auto loads = content->vertical_forces(pressed);
  // Beside the wide band no half of a step has an equilibrium, beside the narrow ones some have.
  for (const double band : {0.05, 0.1, 0.2, 2.0}) {
    Tires tires;
    for (std::size_t i = 0; i < tires.size(); ++i)
      tires[i] = std::make_unique<ChoosyTire>(loads[i], band);
    const auto choosy = Car::make(race_car(false), std::move(tires));
    ASSERT_TRUE(choosy) << choosy.failure().reason;
    const auto found = solve_loaders(**choosy,
                                     loaders,
                                     {pushrods[0], pushrods[1], pushrods[2], pushrods[3]},
                                     road::PlaneRoad{},
                                     0.0);
    ASSERT_FALSE(found) << band;
    EXPECT_NE(found.failure().reason.find("refuses this load"), std::string::npos)
        << band << " N: " << found.failure().reason;
  }
}

TEST(Car, LoadersInALineAreRefused) {
  const auto car = made(race_car(false));
  AeroLoaders loaders;
  loaders.points << 1.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.3, 0.3, 0.3;
  const auto found =
      solve_loaders(*car, loaders, Eigen::Vector4d::Constant(1e3), road::PlaneRoad{}, 0.0);
  ASSERT_FALSE(found);
  EXPECT_NE(found.failure().reason.find("line"), std::string::npos) << found.failure().reason;
}

TEST(Car, OfARackThatMovesItsForcesAreOfOrderTwo) {
  const auto car = made(race_car(true));
  const road::PlaneRoad flat;
  const auto forces_at = [&](double h) {
    CarState state = *car->settle(flat, 20.0, {});
    std::vector<double> forces;
    const int each = static_cast<int>(std::lround(1e-3 / h));
    for (int i = 1; i <= 50 * each; ++i) {
      const double sine = std::sin(std::numbers::pi * i * h / 0.05);
      EXPECT_TRUE(car->advance(state, h, flat, {.rack = 2e-3 * sine * sine * sine}).ok());
      if (i % each == 0) forces.push_back(car->pushrod_forces(state, {.rack = state.rack})[kFL]);
    }
    return forces;
  };
  const auto a = forces_at(1e-4), b = forces_at(5e-5), c = forces_at(2.5e-5);
  EXPECT_GT(rms_between(a, b) / rms_between(b, c), 3.6);
  EXPECT_LT(rms_between(a, b) / rms_between(b, c), 4.4);
}

TEST(Car, AStateIsAValue) {
  const auto car = made(race_car(false));
  const SmoothKerb road;
  CarState state = *car->settle(road, 20.0, {});
  for (int i = 0; i < 300; ++i) ASSERT_TRUE(car->advance(state, 2e-4, road, {}).ok());
  const CarState kept = state;
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(car->advance(state, 2e-4, road, {}).ok());
  EXPECT_FALSE(state == kept);
  CarState again = kept;
  EXPECT_TRUE(again == kept);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(car->advance(again, 2e-4, road, {}).ok());
  EXPECT_TRUE(again == state);
}

TEST(Car, PartsThatMakeNoneAreNamed) {
  CarParameters car = race_car(false);
  car.front.masses.pushrod = 0.0;
  EXPECT_NE(car.fault().find("the push-rod FL has no mass"), std::string::npos) << car.fault();
  car = race_car(false);
  car.rear.inboard->unit = {};
  EXPECT_NE(car.fault().find("the rear axle has no spring"), std::string::npos) << car.fault();
  car = race_car(false);
  std::swap(car.front, car.rear);
  EXPECT_NE(car.fault().find("front axle is not in front"), std::string::npos) << car.fault();
}

}  // namespace
}  // namespace latsch::car
