// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/fe_rolling_tire.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/grip/passing_bar.h"
#include "models/fe_tire/rolling/rolling_tire.h"
#include "models/road/drum_road.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::fe_tire {
namespace {

using Eigen::AngleAxisd, Eigen::Matrix3d, Eigen::Vector3d;

constexpr double kInflation = 2.6e5, kAhead20 = 20.0, kDown = 0.02;  // Pa, m/s, m

TireDescription rolling_description() {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  for (Rubber& rubber : tire.rubbers) rubber.prony = *constant_loss_factor(0.2, 10.0, 1000.0);
  return tire;
}

/// Tire B with few columns on a road, at 20 m/s along x.
class OnARoad : public testing::Test {
 protected:
  OnARoad()
      : description_(rolling_description()),
        losses_(build_losses(description_)),
        elements_(description_),
        inflated_(*elements_.inflate(kInflation)) {}

  FeRollingTire tire(const FeRollingSettings& settings = {}) const {
    return FeRollingTire(
        elements_,
        inflated_,
        losses_,
        [](double) { return RollingFriction{.at_rest = 1.0}; },
        settings);
  }
  WheelMotion wheel(double time,
                    double height,
                    double slip_angle = 0.0,
                    double camber = 0.0) const {
    WheelMotion motion;
    motion.center = {kAhead20 * time, 0.0, height};
    motion.velocity = {kAhead20, 0.0, 0.0};
    motion.carrier = AngleAxisd(-slip_angle, Vector3d::UnitZ()).toRotationMatrix() *
                     AngleAxisd(camber, Vector3d::UnitX()).toRotationMatrix();
    motion.spin_rate = kAhead20 / 0.312;
    return motion;
  }
  double pressed() const { return inflated_.radius - kDown; }
  /// Returns the steady state of RollingTire at a motion.
  RollingState steady(const RollingCase& of) {
    RollingTire rolling(elements_);
    rolling.set_history(losses_, inflated_);
    const auto down = elements_.advance(elements_.over(inflated_, {}, FeTire::Poses::any),
                                        {FeTire::below(inflated_, kDown)});
    RollingCase free;
    free.speed = kAhead20;
    free.spin = kAhead20 / 0.312;
    free.height = of.height;
    free.drive = 0.0;
    free.friction.at_rest = 1.0;
    auto first = rolling.roll(rolling.start(down->back()), free);
    EXPECT_TRUE(first) << first.failure().reason;
    auto found = rolling.roll(*first, of);
    EXPECT_TRUE(found) << found.failure().reason;
    return *found;
  }

  TireDescription description_;
  LossMaterials losses_;
  FeTire elements_;
  Inflated inflated_;
  road::PlaneRoad flat_;
};

HubForces checked(const Result<HubForces>& hub) {
  EXPECT_TRUE(hub) << hub.failure().reason;
  return hub ? *hub : HubForces();
}

// The steady state of RollingTire is that of the first step, and it stays, whether a step is one
// part, several, or no multiple of them. Forces are those of the ground, turned by the camber.
TEST_F(OnARoad, KeepsTheSteadyStateOfItsFirstMotion) {
  constexpr double kAngle = 0.02, kCamber = 0.03;
  FeRollingTire rolling = tire();
  double time = 1e-3;
  const auto at = [&](double t) { return wheel(t, pressed(), kAngle, kCamber); };
  ASSERT_TRUE(rolling.settle(at(0.0), flat_, 0.0));
  const HubForces begin = checked(rolling.advance(at(time), flat_, time, 1e-3));
  RollingCase of;
  of.speed = kAhead20;
  of.slip_angle = kAngle;
  of.camber = kCamber;
  of.height = pressed();
  of.spin = kAhead20 / 0.312;
  of.friction.at_rest = 1.0;
  const RollingState expected = steady(of);
  const double load = expected.forces.force.z();
  const Vector3d in_wheel =
      AngleAxisd(-kCamber, Vector3d::UnitX()).toRotationMatrix() * expected.forces.force;
  EXPECT_LT((begin.force - in_wheel).norm(), 1e-5 * load);
  EXPECT_NEAR(rolling.footprint()->load, load, 1e-5 * load);
  for (const double step : {5e-4, 1e-3, 1e-3, 7e-4, 3e-4}) {
    time += step;
    const HubForces now = checked(rolling.advance(at(time), flat_, time, step));
    EXPECT_LT((now.force - begin.force).norm(), 1e-5 * load) << step;
    EXPECT_LT((now.moment - begin.moment).norm(), 1e-5 * load * pressed()) << step;
  }
}

// A slip angle that grows step by step through Tire and through RollingTransient, whose wheel moves
// alike: the wheel keeps its velocity and turns its heading.
TEST_F(OnARoad, StepsAsTheTransientDoes) {
  constexpr double kStep = 5e-4;
  FeRollingTire rolling = tire();
  ASSERT_TRUE(rolling.settle(wheel(0.0, pressed()), flat_, 0.0));
  checked(rolling.advance(wheel(kStep, pressed()), flat_, kStep, kStep));
  RollingTire states(elements_, 0.5);
  states.set_history(losses_, inflated_);
  const auto down = elements_.advance(elements_.over(inflated_, {}, FeTire::Poses::any),
                                      {FeTire::below(inflated_, kDown)});
  RollingCase of;
  of.speed = kAhead20;
  of.spin = kAhead20 / 0.312;
  of.height = pressed();
  of.drive = 0.0;
  of.friction.at_rest = 1.0;
  const auto free = states.roll(states.start(down->back()), of);
  ASSERT_TRUE(free);
  of.drive.reset();
  const auto begun = states.roll(*free, of);
  ASSERT_TRUE(begun);
  RollingTransient passage(elements_, 0.5);
  passage.set_history(losses_, inflated_);
  ASSERT_TRUE(passage.start(*begun, {}));
  const double load = begun->forces.force.z();
  for (int k = 1; k <= 6; ++k) {
    const double angle = 0.004 * k;
    const HubForces now = checked(
        rolling.advance(wheel((k + 1) * kStep, pressed(), angle), flat_, (k + 1) * kStep, kStep));
    WheelMoment to{.of = begun->of};
    to.of.slip_angle = angle;
    const auto expected = passage.advance(to);
    ASSERT_TRUE(expected) << expected.failure().reason;
    EXPECT_LT((now.force - expected->force).norm(), 2e-3 * load) << k;
  }
}

// A bar of the road and the same bar as its own ground. The road's cells change the height that is
// felt by up to 1/1152 of the bar's (road_ground.h), and leave out arcs of its flanks.
TEST_F(OnARoad, CrossesABarOfItsRoadAsTheTransientCrossesIt) {
  constexpr double kStep = 5e-4, kBar = 0.16;  // s; m, from the start
  constexpr int kSteps = 16;
  const double smooth = elements_.mesh().outer_radius() * elements_.mesh().angle(1);
  const double height = 0.2 * smooth, length = 2.5 * smooth;
  FeRollingTire rolling = tire();
  const road::ProfileRoad road = road::cleat_road(kBar, height, length, 0.0);
  ASSERT_TRUE(rolling.settle(wheel(0.0, pressed()), road, 0.0));
  WheelMotion first = wheel(kStep, pressed());
  FreeWheel spins;
  spins.spin = FreeRate{.inertia = 1.0, .rate = first.spin_rate};
  const HubForces begin = checked(rolling.advance_free(first, spins, road, kStep, kStep));
  RollingTire states(elements_, 0.5);
  states.set_history(losses_, inflated_);
  const auto down = elements_.advance(elements_.over(inflated_, {}, FeTire::Poses::any),
                                      {FeTire::below(inflated_, kDown)});
  RollingCase of;
  of.speed = kAhead20;
  of.spin = kAhead20 / 0.312;
  of.height = pressed();
  of.drive = 0.0;
  of.friction.at_rest = 1.0;
  const auto free = states.roll(states.start(down->back()), of);
  ASSERT_TRUE(free);
  RollingTransient passage(elements_, 0.5);
  passage.set_history(losses_, inflated_);
  const auto still = passage.start(*free, {});
  ASSERT_TRUE(still);
  EXPECT_LT((still->force - begin.force).norm(), 1e-5 * begin.force.z());
  const GroundWithBar bar({.height = height, .length = length, .smooth = smooth});
  double most = 0.0, worst = 0.0;
  for (int k = 2; k <= kSteps; ++k) {
    WheelMotion there = wheel(k * kStep, pressed());
    const HubForces now = checked(rolling.advance_free(there, spins, road, k * kStep, kStep));
    const auto expected = passage.advance({.of = free->of,
                                           .ground = &bar,
                                           .place = {.way = {kAhead20 * k * kStep - kBar, 0.0}},
                                           .wheel = SpinningWheel{.inertia = 1.0}});
    ASSERT_TRUE(expected) << expected.failure().reason;
    most = std::max(most, (expected->force - still->force).norm());
    worst = std::max(worst, (now.force - expected->force).norm());
    EXPECT_NEAR(there.spin_rate, expected->spin, 1e-3 * expected->spin);
  }
  EXPECT_GT(most, 0.05 * begin.force.z());
  EXPECT_LT(worst, 0.03 * most);
  RecordProperty("share", std::to_string(worst / most));
}

// Reduced, the tire crosses a low bar of a road nearly as the full one, whatever a clone of it does
// in between, and leaves the ground and comes back.
TEST_F(OnARoad, ReducedItCrossesABarNearlyAsTheFullTire) {
  constexpr double kStep = 5e-4;
  const double smooth = elements_.mesh().outer_radius() * elements_.mesh().angle(1);
  const road::ProfileRoad road = road::cleat_road(0.16, 0.1 * smooth, 2.5 * smooth, 0.0);
  FeRollingTire full = tire(), reduced = tire({.reduction = ReductionSettings{}});
  std::vector<Vector3d> of_full, of_reduced;
  std::unique_ptr<Tire> clone;
  for (auto [of, forces] : {std::pair(&full, &of_full), std::pair(&reduced, &of_reduced)}) {
    ASSERT_TRUE(of->settle(wheel(0.0, pressed()), road, 0.0));
    FreeWheel spins;
    spins.spin = FreeRate{.inertia = 1.0, .rate = kAhead20 / 0.312};
    for (int k = 1; k <= 20; ++k) {
      WheelMotion there = wheel(k * kStep, pressed());
      forces->push_back(checked(of->advance_free(there, spins, road, k * kStep, kStep)).force);
      if (k != 10 || of == &full) continue;
      clone = of->clone();
      FreeWheel others = spins;
      WheelMotion other = wheel(11 * kStep, pressed() - 1e-3);
      checked(clone->advance_free(other, others, road, 11 * kStep, kStep));
    }
  }
  double most = 0.0, worst = 0.0;
  for (std::size_t k = 0; k < of_full.size(); ++k) {
    most = std::max(most, (of_full[k] - of_full[0]).norm());
    worst = std::max(worst, (of_reduced[k] - of_full[k]).norm());
  }
  EXPECT_GT(most, 0.02 * of_full[0].z());
  EXPECT_LT(worst, 0.1 * most);
  RecordProperty("share", std::to_string(worst / most));
}

// The linear tire follows the ground some 10 mm farther than the full one.
TEST_F(OnARoad, ReducedItLeavesTheGroundAndComesBack) {
  constexpr double kStep = 1e-3;
  FeRollingTire rolling =
      tire({.transient = {.step = 1e-3, .rho = 0.3}, .reduction = ReductionSettings{}});
  ASSERT_TRUE(rolling.settle(wheel(0.0, pressed()), flat_, 0.0));
  std::vector<double> loads;
  for (int k = 1; k <= 150; ++k) {
    const double turn = 2.0 * M_PI * std::min(1.0, k / 70.0), lift = kDown + 0.03;
    WheelMotion there = wheel(k * kStep, pressed() + 0.5 * lift * (1.0 - std::cos(turn)));
    there.velocity.z() = k < 70 ? 0.5 * lift * std::sin(turn) * 2.0 * M_PI / (70.0 * kStep) : 0.0;
    checked(rolling.advance(there, flat_, k * kStep, kStep));
    loads.push_back(*rolling.road_load());
  }
  EXPECT_EQ(loads[34], 0.0);
  EXPECT_NEAR(loads.back(), loads.front(), 0.01 * loads.front());
}

// An axle that is lowered smoothly ends in the steady state of its new height. Fx of the held spin
// gets there over a relaxation length of some meter, 0.05 s.
TEST_F(OnARoad, EndsInTheSteadyStateOfANewHeight) {
  constexpr double kStep = 1e-3, kMore = 0.004;
  FeRollingTire rolling = tire({.transient = {.step = 1e-3, .rho = 0.3}});
  ASSERT_TRUE(rolling.settle(wheel(0.0, pressed()), flat_, 0.0));
  HubForces now;
  for (int k = 1; k <= 300; ++k) {
    const double share = std::min(1.0, k / 40.0);
    WheelMotion there = wheel(k * kStep, pressed() - kMore * share * share * (3.0 - 2.0 * share));
    there.velocity.z() = share < 1.0 ? -kMore * 6.0 * share * (1.0 - share) / (40.0 * kStep) : 0.0;
    now = checked(rolling.advance(there, flat_, k * kStep, kStep));
  }
  RollingCase of;
  of.speed = kAhead20;
  of.height = pressed() - kMore;
  of.spin = kAhead20 / 0.312;
  of.friction.at_rest = 1.0;
  const RollingState expected = steady(of);
  const double load = expected.forces.force.z();
  EXPECT_NEAR(now.force.z(), load, 0.005 * load);
  EXPECT_NEAR(now.force.x(), expected.forces.force.x(), 0.01 * load);
}

// A wheel that leaves the ground and comes back carries its load again, and nothing in between.
TEST_F(OnARoad, LeavesTheGroundAndComesBack) {
  constexpr double kStep = 1e-3;
  FeRollingTire rolling = tire({.transient = {.step = 1e-3, .rho = 0.3}});
  ASSERT_TRUE(rolling.settle(wheel(0.0, pressed()), flat_, 0.0));
  std::vector<double> loads;
  for (int k = 1; k <= 150; ++k) {
    const double turn = 2.0 * M_PI * std::min(1.0, k / 70.0), lift = kDown + 0.01;
    WheelMotion there = wheel(k * kStep, pressed() + 0.5 * lift * (1.0 - std::cos(turn)));
    there.velocity.z() = k < 70 ? 0.5 * lift * std::sin(turn) * 2.0 * M_PI / (70.0 * kStep) : 0.0;
    checked(rolling.advance(there, flat_, k * kStep, kStep));
    loads.push_back(*rolling.road_load());
  }
  EXPECT_EQ(loads[34], 0.0);
  EXPECT_NEAR(loads.back(), loads.front(), 0.01 * loads.front());
}

// A clone goes on as the tire does, to the last bit, whichever of both is moved on first, and a
// step that fails changes nothing.
TEST_F(OnARoad, IsCopiedWithItsState) {
  constexpr double kStep = 5e-4;
  FeRollingTire one = tire();
  ASSERT_TRUE(one.settle(wheel(0.0, pressed()), flat_, 0.0));
  for (int k = 1; k <= 3; ++k)
    checked(one.advance(wheel(k * kStep, pressed() - 2e-4 * k), flat_, k * kStep, kStep));
  const auto other = one.clone();
  const HubForces a =
      checked(one.advance(wheel(4 * kStep, pressed() - 8e-4), flat_, 4 * kStep, kStep));
  checked(one.advance(wheel(5 * kStep, pressed() - 8e-4), flat_, 5 * kStep, kStep));
  WheelMotion backward = wheel(5 * kStep, pressed());
  backward.velocity.x() = -5.0;
  EXPECT_FALSE(other->advance(backward, flat_, 4 * kStep, kStep));
  const HubForces b =
      checked(other->advance(wheel(4 * kStep, pressed() - 8e-4), flat_, 4 * kStep, kStep));
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.moment, b.moment);
}

TEST_F(OnARoad, CarriesTheLoadOfAFreeAxle) {
  constexpr double kStep = 1e-3, kLoad = 4000.0;
  FeRollingTire rolling = tire({.transient = {.step = 1e-3, .rho = 0.3}});
  WheelMotion there = wheel(0.0, pressed());
  ASSERT_TRUE(rolling.settle(there, flat_, 0.0));
  FreeWheel free;
  free.spin = FreeRate{.inertia = 1.0, .rate = there.spin_rate};
  free.height = FreeRate{.place = there.center.z(), .push = [](double, double rate) -> Push {
                           return {-kLoad - 1e5 * rate, -1e5};
                         }};
  for (int k = 1; k <= 5; ++k) {
    WheelMotion next = wheel(k * kStep, there.center.z());
    next.spin_rate = there.spin_rate;
    const HubForces now = checked(rolling.advance_free(next, free, flat_, k * kStep, kStep));
    EXPECT_NEAR(now.force.z(), kLoad, 2e-3 * kLoad) << k;
    there = next;
  }
  EXPECT_LT(there.center.z(), inflated_.radius);
}

TEST_F(OnARoad, SaysWhatItDoesNotDo) {
  FeRollingTire rolling = tire();
  WheelMotion standing = wheel(0.0, pressed());
  EXPECT_FALSE(rolling.advance(standing, flat_, 1e-3, 1e-3));  // it has not settled
  const auto hub = rolling.settle(standing, flat_, 0.0);
  ASSERT_TRUE(hub);
  EXPECT_GT(hub->force.z(), 1000.0);
  standing.velocity.setZero();
  const auto stands = rolling.advance(standing, flat_, 1e-3, 1e-3);
  ASSERT_FALSE(stands);
  EXPECT_NE(stands.failure().reason.find("rolls in time above"), std::string::npos);
  WheelMotion locked = wheel(1e-3, pressed());
  locked.spin_rate = 0.0;
  EXPECT_FALSE(rolling.advance(locked, flat_, 1e-3, 1e-3));
  const road::DrumRoad inside({.diameter = 3.0, .inner = true});
  EXPECT_FALSE(rolling.settle(wheel(0.0, pressed()), inside, 0.0));
}

}  // namespace
}  // namespace latsch::fe_tire
