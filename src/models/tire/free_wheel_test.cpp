// SPDX-License-Identifier: Apache-2.0
#include "models/tire/free_wheel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/road/plane_road.h"
#include "models/tire/free_trials.h"

namespace latsch {
namespace {

/// A tire that consists of springs and a damper, about the wheel's axis and below it, with a weak
/// coupling of spin and height. Its only state is the number of its steps.
class Springs final : public Tire {
 public:
  double by_spin = 0.0, by_height = 0.0, damping = 0.0, coupling = 0.0, hardening = 0.0;
  double broken_above = 1e9;  // m, height above which a step fails
  long steps = 0;

  double free_radius() const override { return 0.3; }
  Result<HubForces> settle(const WheelMotion& motion, const road::Road&, double) override {
    return hub(motion);
  }
  Result<HubForces> advance(const WheelMotion& motion, const road::Road&, double, double) override {
    ++steps;
    if (motion.center.z() > broken_above) return Failure{"broken"};
    return hub(motion);
  }
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    return advance_by_trials(*this, motion, wheel, road, time, step);
  }
  std::unique_ptr<Tire> clone() const override { return std::make_unique<Springs>(*this); }

 private:
  HubForces hub(const WheelMotion& motion) const {
    const double y = motion.spin, z = motion.center.z();
    HubForces hub;
    hub.moment.y() =
        -by_spin * y - damping * motion.spin_rate - coupling * z - hardening * y * y * y;
    hub.force.z() = -by_height * z - coupling * y;
    return hub;
  }
};

const road::PlaneRoad kRoad;

/// Returns the wheel after the given time, divided into `parts` steps.
FreeWheel after(Springs tire, FreeWheel wheel, double time, int parts) {
  WheelMotion motion;
  const double h = time / parts;
  for (int i = 1; i <= parts; ++i) {
    const auto hub = tire.advance_free(motion, wheel, kRoad, i * h, h);
    EXPECT_TRUE(hub) << hub.failure().reason;
    if (!hub) break;
  }
  EXPECT_EQ(tire.steps, parts);
  return wheel;
}

// The equation of motion is J w' = -k y - d w, with y = 0.01 at the start.
TEST(FreeWheel, RingsAsADampedOscillatorDoesToOrderTwo) {
  constexpr double J = 0.8, omega = 200.0, D = 0.1, kTime = 0.05, y0 = 0.01;
  Springs tire;
  tire.by_spin = J * omega * omega;
  tire.damping = 2.0 * D * omega * J;
  FreeWheel wheel;
  wheel.spin = {.inertia = J, .place = y0, .acceleration = -omega * omega * y0};
  const double ringing = omega * std::sqrt(1.0 - D * D);
  const double exact =
      y0 * std::exp(-D * omega * kTime) *
      (std::cos(ringing * kTime) + D * omega / ringing * std::sin(ringing * kTime));
  const auto off = [&](int parts) {
    return std::abs(after(tire, wheel, kTime, parts).spin->place - exact);
  };
  EXPECT_LT(off(1000), 1e-3 * y0);
  for (const int parts : {100, 200, 400, 800})
    EXPECT_NEAR(std::log2(off(parts) / off(2 * parts)), 2.0, 0.05) << parts;
}

// On a spring the trapezoidal rule conserves the energy, and its phase advances by 2 atan(h
// omega/2) per step.
TEST(FreeWheel, KeepsItsEnergyHoweverLongTheStep) {
  for (const double angle : {0.1, 0.6, 2.0, 20.0}) {
    Springs tire;
    tire.by_spin = 1.0;
    FreeWheel wheel;
    wheel.spin = {.inertia = 1.0, .place = 1.0, .acceleration = -1.0};
    WheelMotion motion;
    for (int i = 1; i <= 1000; ++i) {
      ASSERT_TRUE(tire.advance_free(motion, wheel, kRoad, i * angle, angle));
      const double phase = 2.0 * std::atan(0.5 * angle) * i;
      ASSERT_NEAR(wheel.spin->place, std::cos(phase), 1e-5) << angle << " " << i;
      ASSERT_NEAR(wheel.spin->rate, -std::sin(phase), 1e-5) << angle << " " << i;
    }
  }
}

TEST(FreeWheel, TurnsUniformlyFasterUnderAConstantMoment) {
  FreeWheel wheel;
  wheel.spin = {
      .inertia = 0.5, .rate = 3.0, .acceleration = 4.0, .push = [](double, double) -> Push {
        return {2.0, 0.0};
      }};
  const FreeWheel end = after(Springs(), wheel, 2.0, 7);
  EXPECT_NEAR(end.spin->rate, 11.0, 1e-12);
  EXPECT_NEAR(end.spin->place, 14.0, 1e-12);
}

// The equation of motion is J w' = -c w. The moment -c w is not the tire's but an additional one on
// the wheel.
TEST(FreeWheel, AMomentMayHangOnTheRateAndOnTime) {
  FreeWheel wheel;
  wheel.spin = {.inertia = 1.0, .rate = 1.0, .acceleration = -50.0, .push = [](double t, double w) {
                  return Push{-50.0 * w + 3.0 * t, -50.0};
                }};
  constexpr double kTime = 0.1;
  const double exact = 3.0 / 50.0 * (kTime - 0.02) + (1.0 + 3.0 / 2500.0) * std::exp(-50.0 * kTime);
  const auto off = [&](int parts) {
    return std::abs(after(Springs(), wheel, kTime, parts).spin->rate - exact);
  };
  EXPECT_NEAR(std::log2(off(40) / off(80)), 2.0, 0.05);
}

// The tire's law is c z' = T - load. An axle without mass on a spring then comes to rest at load/k,
// for steps of h/tau = 50 as well as for short ones.
TEST(FreeWheel, AnAxleWithoutMassFollowsItsLoad) {
  constexpr double k = 2e5, load = 4000.0;
  for (const double tau : {20e-3, 1e-5}) {
    Springs tire;
    tire.by_height = k;
    const double c = k * tau;
    FreeWheel wheel;
    wheel.height = {.rate = -load / c, .push = [c](double, double w) -> Push {
                      return {-load - c * w, -c};
                    }};
    const double exact = -load / k * (1.0 - std::exp(-0.2 / tau));
    EXPECT_NEAR(after(tire, wheel, 0.2, 400).height->place, exact, 1e-6 * load / k) << tau;
  }
}

// Two springs are coupled: each is loaded by the other's motion. The system has two known modes, of
// which the slower one is excited.
TEST(FreeWheel, SpinAndHeightAreSolvedTogether) {
  Springs tire;
  tire.by_spin = tire.by_height = 1e4;
  tire.coupling = 9e3;
  FreeWheel wheel;
  wheel.spin = {.inertia = 1.0, .place = 0.01, .acceleration = -10.0};
  wheel.height = {.inertia = 1.0, .place = -0.01, .acceleration = 10.0};
  // If spin and height move in opposite directions, their stiffness is k - c and the frequency
  // sqrt(1000) rad/s. The phase is that of the trapezoidal rule itself.
  constexpr int kSteps = 500;
  constexpr double h = 5e-3, omega = 31.6227766016837933;
  for (FreeRate* free : {&*wheel.spin, &*wheel.height}) free->acceleration = -1000.0 * free->place;
  const FreeWheel end = after(tire, wheel, kSteps * h, kSteps);
  const double exact = 0.01 * std::cos(2.0 * std::atan(0.5 * h * omega) * kSteps);
  EXPECT_NEAR(end.spin->place, exact, 1e-5);
  EXPECT_NEAR(end.height->place, -exact, 1e-5);
}

TEST(FreeWheel, ASpringThatIsNotLinearIsSolvedToo) {
  Springs tire;
  tire.by_spin = 1.0;
  tire.hardening = 50.0;
  FreeWheel wheel;
  wheel.spin = {.inertia = 1.0, .place = 1.0, .acceleration = -51.0};
  WheelMotion motion;
  for (int i = 1; i <= 500; ++i) {
    const FreeWheel before = wheel;
    ASSERT_TRUE(tire.advance_free(motion, wheel, kRoad, 0.2 * i, 0.2));
    const double y = wheel.spin->place, w = wheel.spin->rate;
    ASSERT_NEAR(motion.spin, y, 0.0);
    ASSERT_NEAR(y, before.spin->place + 0.1 * (before.spin->rate + w), 1e-12 * std::abs(y));
    ASSERT_NEAR(
        10.0 * (w - before.spin->rate), before.spin->acceleration - y - 50.0 * y * y * y, 1e-6);
  }
}

// A wheel that turns at 10 rad/s, with an inertia of 0.5 kg m^2 and a braking moment of 20 N m,
// stops after 0.25 s and stays at rest.
TEST(FreeWheel, ABrakeLocksItAndHoldsIt) {
  FreeWheel wheel;
  wheel.brake = 20.0;
  wheel.spin = {.inertia = 0.5, .rate = 10.0, .acceleration = -40.0};
  Springs tire;
  WheelMotion motion;
  for (int i = 1; i <= 400; ++i) {
    ASSERT_TRUE(tire.advance_free(motion, wheel, kRoad, 1e-3 * i, 1e-3));
    if (i < 250) {
      ASSERT_NEAR(wheel.spin->rate, 10.0 - 0.04 * i, 1e-9) << i;
    } else {
      ASSERT_NEAR(wheel.spin->rate, 0.0, 1e-9) << i;
    }
  }
  EXPECT_EQ(wheel.spin->rate, 0.0);
  EXPECT_EQ(wheel.spin->acceleration, 0.0);
  // The brake holds the wheel until the driving moment exceeds the brake's largest moment.
  wheel.spin->push = [](double t, double) -> Push { return {100.0 * (t - 0.4), 0.0}; };
  for (int i = 401; i <= 700; ++i) {
    ASSERT_TRUE(tire.advance_free(motion, wheel, kRoad, 1e-3 * i, 1e-3));
    if (i <= 600) {
      ASSERT_EQ(wheel.spin->rate, 0.0) << i;
    }
  }
  EXPECT_NEAR(wheel.spin->rate, 0.5 * 100.0 * 0.1 * 0.1 / 0.5, 1e-9);
}

// The brake's moment jumps at zero speed, which no step resolves. On a spring the wheel comes to
// rest where the spring's moment is smaller than the brake can hold.
TEST(FreeWheel, ABrakedSpringComesToRestWithinItsFriction) {
  for (const double h : {1e-3, 0.05, 3.0}) {
    Springs tire;
    tire.by_spin = 10.0;
    FreeWheel wheel;
    wheel.brake = 2.0;
    wheel.spin = {.inertia = 1.0, .place = 3.0, .acceleration = -28.0};
    WheelMotion motion;
    for (int i = 1; i <= 20000; ++i) ASSERT_TRUE(tire.advance_free(motion, wheel, kRoad, h * i, h));
    EXPECT_EQ(wheel.spin->rate, 0.0) << h;
    EXPECT_LE(std::abs(wheel.spin->place), 0.2) << h;
  }
}

TEST(FreeWheel, AFailureLeavesAllAsItWas) {
  Springs tire;
  tire.broken_above = 0.5;
  FreeWheel wheel;
  wheel.height = {.inertia = 1.0, .rate = 10.0};
  WheelMotion motion;
  motion.spin = 0.25;
  const WheelMotion before = motion;
  EXPECT_FALSE(tire.advance_free(motion, wheel, kRoad, 0.1, 0.1));
  EXPECT_EQ(tire.steps, 0);
  EXPECT_EQ(motion, before);
  EXPECT_EQ(wheel.height->place, 0.0);
  EXPECT_EQ(wheel.height->rate, 10.0);
  // If a driving moment grows with speed faster than the inertia term 2 m/h of the step, the step
  // has no unique solution.
  tire.broken_above = 1e9;
  wheel = {};
  wheel.spin = {.inertia = 1.0, .rate = 1.0, .push = [](double, double w) -> Push {
                  return {50.0 * w, 50.0};
                }};
  EXPECT_FALSE(tire.advance_free(motion, wheel, kRoad, 0.1, 0.1));
  EXPECT_EQ(tire.steps, 0);
}

}  // namespace
}  // namespace latsch
