// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/free_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"

namespace latsch::ring_tire {
namespace {

const road::PlaneRoad kPit({.height = -1.0}), kFlat;
constexpr double kInertia = 0.8;  // kg m^2, inertia of the wheel

/// Returns a ring without damping or friction, with as many lines and blocks as a contact patch
/// needs.
RingParameters undamped_ring() {
  RingParameters ring = passenger_ring();
  for (SidewallElement* of :
       {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
    of->damping = 0.0;
  ring.sidewall.torsion_damping = 0.0;
  return ring;
}

double belt_inertia(const RingParameters& ring) {
  return ring.belt.mass * ring.belt.radius * ring.belt.radius;
}

WheelMotion standing(const RingTire& tire, double deflection) {
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - deflection;
  return motion;
}

WheelMotion rolling(const RingTire& tire, double deflection, double speed) {
  WheelMotion motion = standing(tire, deflection);
  motion.velocity.x() = speed;
  motion.spin_rate = speed / (tire.free_radius() - 0.35 * deflection);
  return motion;
}

FreeWheel free_spin(const WheelMotion& motion, double moment) {
  FreeWheel wheel;
  wheel.spin = {.inertia = kInertia,
                .place = motion.spin,
                .rate = motion.spin_rate,
                .acceleration = moment / kInertia};
  return wheel;
}

/// Advances a tire with a free wheel by one step.
Result<HubForces> go_on(RingTire& tire,
                        WheelMotion& motion,
                        FreeWheel& wheel,
                        const road::Road& road,
                        double time,
                        double h) {
  motion.center.x() += h * motion.velocity.x();
  return tire.advance_free(motion, wheel, road, time, h);
}

// Off the road, wheel and belt oscillate against each other on the springs of the sidewall. Angular
// momentum is constant, and the relative motion oscillates with omega^2 = K (1/I + 1/I_b).
TEST(FreeRows, TheWheelRingsAgainstTheBeltToOrderTwo) {
  const RingParameters ring = undamped_ring();
  const double R = ring.belt.radius, I_b = belt_inertia(ring);
  const double K = ring.sidewall.tangential.stiffness * 2.0 * std::numbers::pi * R * R * R;
  const double omega = std::sqrt(K * (1.0 / kInertia + 1.0 / I_b));
  constexpr double kRate = 0.1, kTime = 0.02;
  const double share = I_b / (kInertia + I_b);
  const double exact = kRate * ((1.0 - share) * kTime + share / omega * std::sin(omega * kTime));
  const auto off = [&](int parts) {
    RingTire tire(ring, {.dissipation = 0.0, .tolerance = 1e-7});
    WheelMotion motion = standing(tire, 0.0);
    EXPECT_TRUE(tire.settle(motion, kPit, 0.0));
    FreeWheel wheel = free_spin(motion, 0.0);
    wheel.spin->rate = kRate;
    const double h = kTime / parts;
    for (int i = 1; i <= parts; ++i) {
      const auto hub = tire.advance_free(motion, wheel, kPit, i * h, h);
      EXPECT_TRUE(hub) << hub.failure().reason;
    }
    return std::abs(motion.spin - exact);
  };
  EXPECT_LT(off(400), 1e-3 * kRate / omega);
  for (const int parts : {50, 100, 200})
    EXPECT_NEAR(std::log2(off(parts) / off(2 * parts)), 2.0, 0.1) << parts;
}

// With the stiffness multiplied by 20 the frequency is 290 Hz, so that h omega is 0.9, 3.6 and 18
// in the three steps.
TEST(FreeRows, NoEnergyComesOfLongSteps) {
  RingParameters stiff = undamped_ring();
  for (SidewallElement* of :
       {&stiff.sidewall.radial, &stiff.sidewall.tangential, &stiff.sidewall.lateral})
    of->stiffness *= 20.0;
  for (const double h : {5e-4, 2e-3, 1e-2}) {
    for (const double dissipation : {0.0, 0.05}) {
      RingTire tire(stiff, {.dissipation = dissipation, .tolerance = 1e-7, .largest_step = 1e-2});
      WheelMotion motion = standing(tire, 0.0);
      ASSERT_TRUE(tire.settle(motion, kPit, 0.0));
      FreeWheel wheel = free_spin(motion, 0.0);
      wheel.spin->rate = 1.0;
      const double rest = tire.energy();  // the energy at rest includes that of the pressure
      const auto energy = [&] {
        return tire.energy() - rest + 0.5 * kInertia * wheel.spin->rate * wheel.spin->rate;
      };
      const double first = energy();
      // If θ is above 0, the integration (17) keeps an energy other than the mechanical one from
      // growing. The mechanical energy may therefore rise, but it returns to its initial value.
      double most = 0.0, later = 0.0;
      for (int i = 1; i <= 2000; ++i) {
        const auto hub = tire.advance_free(motion, wheel, kPit, i * h, h);
        ASSERT_TRUE(hub) << hub.failure().reason;
        (i <= 1000 ? most : later) = std::max(i <= 1000 ? most : later, energy());
      }
      EXPECT_LT(most, first * (dissipation == 0.0 ? 1.001 : 1.25)) << h << " " << dissipation;
      EXPECT_LT(later, most * (1.0 + 1e-4)) << h << " " << dissipation;
      EXPECT_GT(most, 0.5 * first);
    }
  }
}

/// Returns Fx and the speed of the wheel after a moment has acted on a standing wheel for 20 ms,
/// while all of the touching tread sticks.
std::pair<double, double> turned_on(double h) {
  RingTire tire(passenger_ring(), {.tolerance = 1e-5});
  WheelMotion motion = standing(tire, 0.018);
  auto hub = tire.settle(motion, kFlat, 0.0);
  EXPECT_TRUE(hub);
  FreeWheel wheel = free_spin(motion, 0.0);
  const double rest = hub->moment.y();
  wheel.spin->push = [rest](double t, double) -> Push {
    return {150.0 * std::pow(std::sin(2.0 * std::numbers::pi * 60.0 * t), 2) - rest, 0.0};
  };
  for (int i = 1; i <= std::lround(0.02 / h); ++i) {
    hub = tire.advance_free(motion, wheel, kFlat, i * h, h);
    EXPECT_TRUE(hub) << hub.failure().reason;
  }
  return {hub->force.x(), motion.spin_rate};
}

TEST(FreeRows, OnAStickingTreadForceAndSpeedAreOfOrderTwo) {
  std::vector<std::pair<double, double>> at;
  for (const double h : {5e-4, 2.5e-4, 1.25e-4, 6.25e-5}) at.push_back(turned_on(h));
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_NEAR((at[i].first - at[i + 1].first) / (at[i + 1].first - at[i + 2].first), 4.0, 0.25);
    EXPECT_NEAR(
        (at[i].second - at[i + 1].second) / (at[i + 1].second - at[i + 2].second), 4.0, 0.25);
  }
}

/// Returns Fx and the speed of the wheel every millisecond, while it rolls over a cleat that rises
/// over a length of 50 mm.
std::pair<std::vector<double>, std::vector<double>> over_a_cleat(double h, double from) {
  road::ProfileRoad::Settings settings;
  settings.along = road::Profile({{-0.06, 0.0}, {-0.01, 0.01}, {0.01, 0.01}, {0.06, 0.0}});
  settings.origin.x() = from;
  const road::ProfileRoad road(settings);
  RingParameters ring = passenger_ring();
  ring.tread.damping_time = 1e-4;
  RingTire tire(ring, {.tolerance = 1e-4});
  WheelMotion motion = rolling(tire, 0.018, 10.0);
  const auto stands = tire.settle(motion, road, 0.0);
  EXPECT_TRUE(stands);
  FreeWheel wheel = free_spin(motion, stands->moment.y());
  std::vector<double> Fx, speed;
  for (int i = 1; i <= std::lround(0.04 / h); ++i) {
    const auto hub = go_on(tire, motion, wheel, road, i * h, h);
    EXPECT_TRUE(hub) << hub.failure().reason;
    if (!hub) break;
    if (i % std::lround(1e-3 / h) != 0) continue;
    Fx.push_back(hub->force.x());
    speed.push_back(motion.spin_rate);
  }
  return {Fx, speed};
}

double sum_of_squares(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// If the step is halved twice, the change of the results decreases by a factor of sixteen at order
// 2, and of four at order 1. Blocks that come into contact or leave it within a step cause a
// scatter, 0.2 N of Fx at the finest steps, as they do with a prescribed spin. The test therefore
// sums over eight passages.
TEST(FreeRows, OverACleatForceAndSpeedAreOfOrderTwo) {
  double coarse[2] = {}, fine[2] = {};
  for (int passage = 0; passage < 8; ++passage) {
    std::vector<std::pair<std::vector<double>, std::vector<double>>> runs;
    for (const double h : {2e-4, 1e-4, 5e-5, 2.5e-5})
      runs.push_back(over_a_cleat(h, 0.2 + 0.0037 * passage));
    coarse[0] += sum_of_squares(runs[0].first, runs[1].first);
    coarse[1] += sum_of_squares(runs[0].second, runs[1].second);
    fine[0] += sum_of_squares(runs[2].first, runs[3].first);
    fine[1] += sum_of_squares(runs[2].second, runs[3].second);
  }
  EXPECT_GT(std::sqrt(coarse[0] / fine[0]), 7.0);
  EXPECT_GT(std::sqrt(coarse[1] / fine[1]), 7.0);
}

/// Rolls a wheel with an axle of 300 kg over a cleat, under a load, and calls `check` after each
/// step.
template <class Check>
void roll_over_a_cleat(const RingParameters& ring, double h, const Check& check) {
  const road::ProfileRoad road = road::cleat_road(0.3, 0.015, 0.03, 0.005);
  RingTire tire(ring);
  WheelMotion motion = rolling(tire, 0.018, 40.0 / 3.6);
  const auto stands = tire.settle(motion, road, 0.0);
  ASSERT_TRUE(stands) << stands.failure().reason;
  FreeWheel wheel = free_spin(motion, stands->moment.y());
  const double weight = stands->force.z();
  wheel.height = {
      .inertia = 300.0, .place = motion.center.z(), .push = [weight](double, double) -> Push {
        return {-weight, 0.0};
      }};
  for (int i = 1; i <= std::lround(0.06 / h); ++i) {
    const RingState state = tire.state();
    const FreeWheel before = wheel;
    const auto hub = go_on(tire, motion, wheel, road, i * h, h);
    ASSERT_TRUE(hub) << hub.failure().reason;
    check(tire, state, before, wheel, motion, *hub, road, i * h);
  }
}

// At the end of each step both the ring's and the wheel's equations must hold. The step must equal
// one in which the resulting motion is prescribed.
TEST(FreeRows, StepAndWheelAreSolvedTogether) {
  for (const double bending : {0.0, 8.0}) {
    RingParameters ring = passenger_ring();
    ring.belt.bending_across = bending;
    constexpr double h = 5e-4;
    double most = 0.0, farthest = 0.0;
    roll_over_a_cleat(ring,
                      h,
                      [&](RingTire& tire,
                          const RingState& state,
                          const FreeWheel& before,
                          const FreeWheel& wheel,
                          const WheelMotion& motion,
                          const HubForces& hub,
                          const road::Road& road,
                          double time) {
                        const FreeWheel::Pair rates(wheel.spin->rate, wheel.height->rate);
                        const FreeWheel::Pair T = FreeWheel::forces(hub, motion);
                        const auto left = before.left(time, h, rates, T);
                        most = std::max({most, std::abs(left[0]), std::abs(left[1])});
                        ASSERT_EQ(motion.spin, wheel.spin->place);
                        ASSERT_EQ(motion.velocity.z(), wheel.height->rate);
                        if (std::lround(time / h) % 10 != 0) return;
                        RingTire told(ring);
                        const auto same = told.trial(state, motion, road, time, h);
                        ASSERT_TRUE(same);
                        farthest = std::max(farthest, (same->hub.force - hub.force).norm());
                        (void)tire;
                      });
    EXPECT_LT(most, 0.1) << bending;
    EXPECT_LT(farthest, 0.5) << bending;
  }
}

TEST(FreeRows, AStepIsAFunctionOfItsArguments) {
  roll_over_a_cleat(passenger_ring(),
                    5e-4,
                    [&](RingTire&,
                        const RingState& state,
                        const FreeWheel& before,
                        const FreeWheel& wheel,
                        const WheelMotion& motion,
                        const HubForces&,
                        const road::Road& road,
                        double time) {
                      if (std::lround(time / 5e-4) % 20 != 0) return;
                      HubForces forces[2];
                      RingState ends[2];
                      FreeWheel wheels[2];
                      RingTire other(passenger_ring());
                      for (const int i : {0, 1}) {
                        other.restore(state);
                        wheels[i] = before;
                        WheelMotion to = motion;
                        to.spin = to.spin_rate = to.center.z() = to.velocity.z() = 99.0;
                        const auto hub = other.advance_free(to, wheels[i], road, time, 5e-4);
                        ASSERT_TRUE(hub);
                        forces[i] = *hub;
                        ends[i] = other.state();
                      }
                      EXPECT_EQ(ends[0], ends[1]);
                      EXPECT_EQ(forces[0].force, forces[1].force);
                      EXPECT_EQ(wheels[0].spin->rate, wheels[1].spin->rate);
                      EXPECT_NEAR(wheels[0].spin->rate, wheel.spin->rate, 1e-5);
                    });
}

// The derivatives of the wheel's equations are exact, so Newton's method must not need more
// evaluations for a free wheel.
TEST(FreeRows, AFreeWheelTakesNoMoreEvaluations) {
  constexpr double h = 5e-4;
  std::vector<WheelMotion> motions;
  long evaluations = 0, before = 0;
  roll_over_a_cleat(passenger_ring(),
                    h,
                    [&](RingTire& tire,
                        const RingState&,
                        const FreeWheel&,
                        const FreeWheel&,
                        const WheelMotion& motion,
                        const HubForces&,
                        const road::Road&,
                        double) {
                      if (motions.empty()) before = tire.counts().evaluations;
                      motions.push_back(motion);
                      evaluations = tire.counts().evaluations - before;
                    });
  ASSERT_EQ(motions.size(), 120u);
  const road::ProfileRoad road = road::cleat_road(0.3, 0.015, 0.03, 0.005);
  RingTire told(passenger_ring());
  ASSERT_TRUE(told.settle(rolling(told, 0.018, 40.0 / 3.6), road, 0.0));
  ASSERT_TRUE(told.advance(motions[0], road, h, h));
  const long first = told.counts().evaluations;
  for (std::size_t i = 1; i < motions.size(); ++i)
    ASSERT_TRUE(told.advance(motions[i], road, static_cast<double>(i + 1) * h, h));
  EXPECT_LT(static_cast<double>(evaluations),
            1.05 * static_cast<double>(told.counts().evaluations - first));
}

// A step longer than the limit is divided into parts. The step of the free wheel must be divided in
// the same way.
TEST(FreeRows, ALongStepIsTwoShortOnes) {
  constexpr double h = 2e-3;
  const auto run = [](int parts) {
    RingTire tire(passenger_ring(), {.tolerance = 1e-5, .largest_step = h});
    WheelMotion motion = standing(tire, 0.018);
    const auto stands = tire.settle(motion, kFlat, 0.0);
    EXPECT_TRUE(stands);
    FreeWheel wheel = free_spin(motion, stands->moment.y());
    wheel.spin->push = [](double t, double w) -> Push { return {3e4 * t - w, -1.0}; };
    wheel.height = {.inertia = 20.0, .place = motion.center.z(), .rate = 0.1};
    for (int i = 1; i <= parts; ++i)
      EXPECT_TRUE(tire.advance_free(motion, wheel, kFlat, 2.0 * h * i / parts, 2.0 * h / parts));
    return motion;
  };
  const WheelMotion one = run(1), two = run(2);
  EXPECT_NEAR(one.spin_rate, two.spin_rate, 1e-9);
  EXPECT_NEAR(one.spin, two.spin, 1e-12);
  EXPECT_NEAR(one.center.z(), two.center.z(), 1e-12);
  EXPECT_GT(one.spin_rate, 1e-2);
}

TEST(FreeRows, AFailureLeavesAllAsItWas) {
  RingTire tire(passenger_ring());
  WheelMotion motion = standing(tire, 0.018);
  const auto stands = tire.settle(motion, kFlat, 0.0);
  ASSERT_TRUE(stands);
  FreeWheel wheel = free_spin(motion, stands->moment.y());
  wheel.height = {.inertia = 10.0, .place = motion.center.z(), .rate = -500.0};
  const RingState state = tire.state();
  const WheelMotion before = motion;
  EXPECT_FALSE(tire.advance_free(motion, wheel, kFlat, 2e-3, 2e-3));
  EXPECT_EQ(tire.state(), state);
  EXPECT_EQ(motion, before);
  EXPECT_EQ(wheel.height->rate, -500.0);
  EXPECT_EQ(wheel.spin->rate, 0.0);
  // Rates that are NaN or infinite must lead to a Failure, too.
  wheel.height.reset();
  wheel.spin->push = [](double, double) -> Push { return {std::nan(""), 0.0}; };
  EXPECT_FALSE(tire.advance_free(motion, wheel, kFlat, 1e-3, 1e-3));
  EXPECT_EQ(tire.state(), state);
}

// Off the road the equation (I + I_b) w' = M holds after belt and wheel have begun to rotate
// together.
TEST(FreeRows, ADrivenWheelTakesItsBeltAlong) {
  constexpr double M = 60.0, h = 5e-4;
  RingTire tire(passenger_ring());
  WheelMotion motion = standing(tire, 0.0);
  ASSERT_TRUE(tire.settle(motion, kPit, 0.0));
  FreeWheel wheel = free_spin(motion, M);
  wheel.spin->push = [](double, double) -> Push { return {M, 0.0}; };
  double then = 0.0;
  for (int i = 1; i <= 1200; ++i) {
    ASSERT_TRUE(tire.advance_free(motion, wheel, kPit, i * h, h));
    if (i == 1000) then = motion.spin_rate;
  }
  // The rotation at 60 rad/s expands the belt, which increases its inertia by some tenths of a
  // percent.
  const double rate = M / (kInertia + belt_inertia(passenger_ring()));
  EXPECT_NEAR((motion.spin_rate - then) / (200 * h), rate, 5e-3 * rate);
}

// The tire rolls at 10 m/s and is braked by twice the moment that friction can bear. The wheel must
// lock, slide and stay locked.
TEST(FreeRows, ABrakedWheelLocks) {
  constexpr double h = 5e-4;
  RingTire tire(passenger_ring());
  WheelMotion motion = rolling(tire, 0.018, 10.0);
  const auto stands = tire.settle(motion, kFlat, 0.0);
  ASSERT_TRUE(stands);
  FreeWheel wheel = free_spin(motion, stands->moment.y());
  HubForces forces;
  int locked = 0;
  for (int i = 1; i <= 600; ++i) {
    wheel.brake = i > 100 ? 2500.0 : 0.0;
    const auto hub = go_on(tire, motion, wheel, kFlat, i * h, h);
    ASSERT_TRUE(hub) << hub.failure().reason;
    forces = *hub;
    ASSERT_GE(motion.spin_rate, 0.0) << i;
    if (locked > 0) {
      ASSERT_EQ(motion.spin_rate, 0.0) << i;
    } else if (motion.spin_rate == 0.0) {
      locked = i;
    }
  }
  // A wheel with an inertia of 1.2 kg m^2 is stopped from 32 rad/s by 2500 N m minus the moment of
  // the road, which grows from none to 1100 N m.
  EXPECT_GT(locked, 100 + 31);
  EXPECT_LT(locked, 100 + 57);
  const double mu = -forces.force.x() / forces.force.z();
  EXPECT_GT(mu, 0.7);
  EXPECT_LT(mu, 1.1);
}

// The axle of a flat-track rig obeys c z' = Fz - load.
TEST(FreeRows, AnAxleWithoutMassComesToItsLoad) {
  constexpr double h = 5e-4;
  for (const double load : {4000.0, 50.0}) {
    RingTire tire(passenger_ring());
    WheelMotion motion = standing(tire, 0.010);
    const auto stands = tire.settle(motion, kFlat, 0.0);
    ASSERT_TRUE(stands);
    const double c = 2e3;
    FreeWheel wheel;
    wheel.height = {.place = motion.center.z(),
                    .rate = (stands->force.z() - load) / c,
                    .push = [=](double, double w) -> Push {
                      return {-load - c * w, -c};
                    }};
    for (int i = 1; i <= 800; ++i) {
      const auto hub = tire.advance_free(motion, wheel, kFlat, i * h, h);
      ASSERT_TRUE(hub) << hub.failure().reason;
      if (i > 600) {
        ASSERT_NEAR(hub->force.z(), load, 0.5) << i;
      }
    }
  }
}

}  // namespace
}  // namespace latsch::ring_tire
