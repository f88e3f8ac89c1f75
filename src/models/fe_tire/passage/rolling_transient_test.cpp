// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/rolling_transient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "models/fe_tire/grip/passing_bar.h"
#include "models/fe_tire/passage/passing_tire_testing.h"
#include "models/fe_tire/rolling/rolling_response.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {
namespace {

class RollingTransientTest : public testing::TestWithParam<bool> {};

TEST_P(RollingTransientTest, KeepsASteadyStateWithSlipAndCamber) {
  Passing tire(GetParam());
  RollingCase of = tire.free_.of;
  of.drive.reset();
  of.slip_angle = 0.02;
  of.camber = 0.03;
  of.spin *= 1.01;
  const RollingState steady = tire.roll(tire.free_, of);
  const double load = steady.forces.force.z();
  // The step is no multiple of the time between points.
  const TransientForces begin = tire.start(steady, {.step = 3.3e-4});
  TransientForces end;
  for (int k = 0; k < 8; ++k) end = tire.advance({.of = of});
  EXPECT_LT((end.ground.force - steady.forces.force).norm(), 1e-5 * load);
  EXPECT_LT((end.force - begin.force).norm(), 1e-5 * load);
  EXPECT_LT((end.moment - begin.moment).norm(), 1e-5 * load * of.height);
  // On the hub the forces are those of the ground, turned by the camber.
  const Eigen::Vector3d& ground = steady.forces.force;
  const double c = std::cos(of.camber), s = std::sin(of.camber);
  EXPECT_NEAR(begin.force.x(), ground.x(), 1e-6 * load);
  EXPECT_NEAR(begin.force.y(), c * ground.y() + s * ground.z(), 1e-6 * load);
  EXPECT_NEAR(begin.force.z(), c * ground.z() - s * ground.y(), 1e-6 * load);
}

INSTANTIATE_TEST_SUITE_P(ElasticAndRelaxing, RollingTransientTest, testing::Bool());

TEST(RollingTransient, KeepsAFreeWheelFree) {
  Passing tire(true);
  tire.start(tire.free_, {});
  for (int k = 0; k < 10; ++k) {
    const TransientForces now =
        tire.advance({.of = tire.free_.of, .wheel = SpinningWheel{.inertia = 1.0}});
    EXPECT_NEAR(now.spin, tire.free_.of.spin, 1e-6 * tire.free_.of.spin);
  }
}

// With a moment on the wheel that stays, the spin ends at that of the steady state with this drive.
TEST(RollingTransient, EndsWithTheSteadySpinOfItsDrive) {
  constexpr double kDrive = 60.0;  // N m
  Passing tire(true);
  RollingCase driven = tire.free_.of;
  driven.drive = kDrive;
  const RollingState steady = tire.roll(tire.free_, driven);
  tire.start(tire.free_, {.step = 1e-3, .rho = 0.3});
  TransientForces now;
  for (int k = 1; k <= 200; ++k) {
    const double moment = kDrive * std::min(1.0, k / 50.0);
    now = tire.advance({.of = tire.free_.of, .wheel = SpinningWheel{0.4, moment}});
  }
  const double change = steady.of.spin - tire.free_.of.spin;
  EXPECT_NEAR(now.spin - tire.free_.of.spin, change, 0.02 * std::abs(change));
  EXPECT_NEAR(now.ground.force.x(), steady.forces.force.x(), 0.02 * steady.forces.force.x());
}

// A slip angle that is reached and kept ends in the steady state of that slip angle, whatever the
// size of the steps.
TEST(RollingTransient, EndsInTheSteadyStateOfANewSlipAngle) {
  constexpr double kAngle = 0.03, kPatch = 0.1;  // rad; m, length of the patch
  Passing tire(true);
  RollingCase of = tire.free_.of;
  of.drive.reset();
  of.slip_angle = kAngle;
  of.speed = kRollsAt / std::cos(kAngle);
  const RollingState steady = tire.roll(tire.free_, of);
  tire.start(tire.free_, {.step = 1e-3, .rho = 0.3});
  TransientForces now;
  for (int k = 1; k <= 220; ++k) {
    WheelMoment to{.of = of};
    const double share = std::min(1.0, k / 60.0);
    to.of.slip_angle = share * kAngle;
    to.of.speed = kRollsAt / std::cos(to.of.slip_angle);
    now = tire.advance(to);
  }
  const RollingForces &found = now.ground, &expected = steady.forces;
  EXPECT_NEAR(found.force.x(), expected.force.x(), 0.01 * std::abs(expected.force.y()));
  EXPECT_NEAR(found.force.y(), expected.force.y(), 0.01 * std::abs(expected.force.y()));
  EXPECT_NEAR(found.force.z(), expected.force.z(), 0.01 * expected.force.z());
  EXPECT_NEAR(found.moment.z(), expected.moment.z(), 0.01 * expected.force.z() * kPatch);
}

/// Amplitude of what follows cos(omega t) and sin(omega t) in samples of one period.
std::complex<double> at_frequency(const std::vector<double>& values) {
  std::complex<double> sum = 0.0;
  const double n = static_cast<double>(values.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    sum += values[k] * std::polar(2.0 / n, -2.0 * std::numbers::pi * static_cast<double>(k) / n);
  return sum;
}

// Slip angles that swing slowly let the side force lag as the response in frequency says (F.4),
// which has no steps of time and no inertia. At 4 Hz and 30 m/s size and phase differ by 7 %, which
// we take for gyroscopic forces.
TEST(RollingTransient, LagsBehindSlowSlipAnglesAsTheResponseInFrequencySays) {
  constexpr double kFrequency = 0.4, kSwing = 2e-3, kStep = 5e-3, kSlow = 5.0;
  Passing tire(false, 1.0, kSlow);
  const auto response = RollingResponse::about(tire.tire_, tire.free_);
  ASSERT_TRUE(response) << response.failure().reason;
  const std::complex<double> expected = response->by(SlipInput::angle, kFrequency).force.y();
  tire.start(tire.free_, {.step = kStep, .rho = 0.0});
  const int period = static_cast<int>(std::lround(1.0 / (kFrequency * kStep)));
  std::vector<double> side;
  for (int k = 1; k <= period + period / 2; ++k) {
    const double phase = 2.0 * std::numbers::pi * k / period;
    WheelMoment to{.of = tire.free_.of};
    to.of.slip_angle = kSwing * std::sin(phase);
    to.of.speed = kSlow / std::cos(to.of.slip_angle);
    const TransientForces now = tire.advance(to);
    if (k > period / 2) side.push_back(now.ground.force.y());
  }
  // The samples begin one step after half a period, at -sin.
  const double first = std::numbers::pi + 2.0 * std::numbers::pi / period;
  const std::complex<double> found =
      at_frequency(side) * std::polar(1.0 / kSwing, -first) * std::complex<double>(0.0, 1.0);
  EXPECT_NEAR(std::abs(found), std::abs(expected), 0.02 * std::abs(expected));
  EXPECT_NEAR(std::arg(found / expected), 0.0, 0.02);
}

// Halved steps have a quarter of the error. The axle rises so little that no point comes down or
// lifts off, and so slowly that it excites no vibration that these steps do not follow.
TEST(RollingTransient, IsOfSecondOrder) {
  Passing tire(false, std::nullopt);
  const auto load = [&](double step) {
    tire.start(tire.free_, {.step = step, .rho = 0.7, .enough = 1e-9});
    TransientForces now;
    const double end = 0.03;
    for (long k = 1; k <= std::lround(end / step); ++k) {
      const double share = k * step / end, rise = 2e-6;
      // A smooth rise of the axle, whose acceleration is that of the axes.
      WheelMoment to{.of = tire.free_.of};
      to.of.height += rise * share * share * share * (10.0 - 15.0 * share + 6.0 * share * share);
      to.acceleration.z() = rise / (end * end) *
                            (60.0 * share - 180.0 * share * share + 120.0 * share * share * share);
      now = tire.advance(to);
    }
    return now.force.z();
  };
  const double coarse = load(1e-3), middle = load(5e-4), fine = load(2.5e-4);
  EXPECT_NEAR((coarse - middle) / (middle - fine), 4.0, 1.0);
}

TEST(RollingTransient, RollsOverABarAndSettles) {
  Passing tire(true);
  const TransientForces begin = tire.start(tire.free_, {});
  const GroundWithBar bar({.height = 0.005, .length = 0.02});
  double most = 0.0;
  TransientForces now;
  double late = 0.0;  // N, largest change in the last 20 ms
  for (int k = 1; k <= 120; ++k) {
    now = tire.advance({.of = tire.free_.of,
                        .ground = &bar,
                        .place = {.way = {kRollsAt * 5e-4 * k - 0.12, 0.0}},
                        .wheel = SpinningWheel{.inertia = 1.0}});
    most = std::max(most, now.force.z() - begin.force.z());
    if (k > 80) late = std::max(late, std::abs(now.force.z() - begin.force.z()));
  }
  EXPECT_GT(most, 0.1 * begin.force.z());
  EXPECT_LT(late, 0.5 * most);
  EXPECT_NEAR(now.spin, tire.free_.of.spin, 0.01 * tire.free_.of.spin);
}

// The ground turns below a wheel that turns, as the steady state with turn slip has it.
TEST(RollingTransient, KeepsASteadyStateWithTurnSlip) {
  Passing tire(true);
  RollingCase of = tire.free_.of;
  of.drive.reset();
  of.turn_slip = 0.02;
  const RollingState steady = tire.roll(tire.free_, of);
  const double load = steady.forces.force.z();
  const TransientForces begin = tire.start(steady, {.step = 3.3e-4});
  TransientForces end;
  for (int k = 0; k < 8; ++k) end = tire.advance({.of = of});
  EXPECT_LT((end.ground.force - steady.forces.force).norm(), 1e-5 * load);
  EXPECT_LT((end.moment - begin.moment).norm(), 1e-5 * load * of.height);
  EXPECT_GT(std::abs(steady.forces.moment.z()), 1e-4 * load * of.height);
}

TEST(RollingTransient, GoesBackToAStateThatWasKept) {
  Passing tire(true);
  tire.start(tire.free_, {});
  const auto at = [&](int k) {
    WheelMoment to{.of = tire.free_.of};
    to.of.height -= 2e-4 * k;
    return to;
  };
  for (int k = 1; k <= 3; ++k) tire.advance(at(k));
  TransientState kept = tire.passage_.state();
  const TransientForces once = tire.advance(at(4));
  for (int k = 5; k <= 7; ++k) tire.advance(at(k));
  tire.passage_.resume(std::move(kept));
  const TransientForces again = tire.advance(at(4));
  EXPECT_EQ(once.force, again.force);
  EXPECT_EQ(once.moment, again.moment);
}

TEST(RollingTransient, StopsAWheelByItsBrake) {
  constexpr double kBrake = 200.0;  // N m
  Passing tire(true);
  const TransientForces begin = tire.start(tire.free_, {});
  TransientForces now;
  for (int k = 1; k <= 4; ++k)
    now = tire.advance(
        {.of = tire.free_.of, .wheel = SpinningWheel{.inertia = 1.0, .brake = kBrake}});
  // The brake slows the wheel at once; the ground holds it a little later.
  EXPECT_LT(now.spin, begin.spin - 0.25 * kBrake * 4 * 5e-4);
  EXPECT_GT(now.spin, begin.spin - kBrake * 4 * 5e-4);
}

TEST(RollingTransient, RefusesAWheelThatStands) {
  Passing tire(false);
  EXPECT_FALSE(tire.passage_.start(tire.start_, {}));
}

}  // namespace
}  // namespace latsch::fe_tire
