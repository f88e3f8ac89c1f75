// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/reduced_passage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "models/fe_tire/passage/passing_tire_testing.h"
#include "models/fe_tire/passage/reduced_states.h"

namespace latsch::fe_tire {
namespace {

constexpr double kShortStep = 5e-4;  // s

TransientForces begin(ReducedPassage& passage, const RollingState& steady, double step) {
  auto found = passage.start(steady, {.step = step, .enough = 1e-5});
  EXPECT_TRUE(found) << found.failure().reason;
  return *found;
}

TransientForces go_on(ReducedPassage& passage, const WheelMoment& to) {
  auto found = passage.advance(to);
  EXPECT_TRUE(found) << found.failure().reason;
  return found ? *found : TransientForces();
}

/// Motion of the wheel at a time, s, from its steady state.
using Motion = std::function<WheelMoment(RollingCase of, double time)>;

/// Changes of the six numbers on the hub during a motion, [6 x steps], with the full and the
/// reduced tire.
struct BothTires {
  Eigen::MatrixXd full, reduced;

  BothTires(Passing& tire, const RollingState& from, int steps, const Motion& motion) {
    full.resize(6, steps);
    reduced.resize(6, steps);
    const auto both = [](const TransientForces& of) {
      Eigen::Vector<double, 6> all;
      all << of.force, of.moment;
      return all;
    };
    Eigen::Vector<double, 6> still = both(tire.start(from, {.step = kShortStep, .enough = 1e-5}));
    for (int k = 0; k < steps; ++k)
      full.col(k) = both(tire.advance(motion(from.of, (k + 1) * kShortStep))) - still;
    ReducedPassage passage(tire.passage_);
    still = both(begin(passage, from, kShortStep));
    for (int k = 0; k < steps; ++k)
      reduced.col(k) = both(go_on(passage, motion(from.of, (k + 1) * kShortStep))) - still;
  }
  /// Returns the root mean square of the difference of a number relative to that of the full tire.
  double error(int row) const {
    return (reduced.row(row) - full.row(row)).norm() / full.row(row).norm();
  }
};

class ReducedPassageTest : public testing::TestWithParam<bool> {};

TEST_P(ReducedPassageTest, KeepsASteadyStateWithSlipAndCamber) {
  Passing tire(GetParam());
  RollingCase of = tire.free_.of;
  of.drive.reset();
  of.slip_angle = 0.02;
  of.camber = 0.03;
  of.spin *= 1.01;
  const RollingState steady = tire.roll(tire.free_, of);
  const double load = steady.forces.force.z();
  ReducedPassage passage(tire.passage_);
  const TransientForces first = begin(passage, steady, 3.3e-4);
  TransientForces end;
  for (int k = 0; k < 8; ++k) end = go_on(passage, {.of = of});
  EXPECT_LT((end.force - first.force).norm(), 1e-4 * load);
  EXPECT_LT((end.moment - first.moment).norm(), 1e-4 * load * of.height);
}

/// Largest errors relative to the full tire, elastic and with rubber of a loss factor of 0.2, whose
/// history (V.9) carries approximately: by 3 % of Fz, 6 % of Fy and 4 % of Fx.
double most(bool relaxes, double elastic, double relaxing) { return relaxes ? relaxing : elastic; }

// A small change of a steady state judges the whole of (V.8) and (V.11): elements, pressure,
// centrifugal forces, contact, and the history that the material carries around.
TEST_P(ReducedPassageTest, HasTheFullTiresSteadyStatesNearby) {
  Passing tire(GetParam());
  ReducedPassage passage(tire.passage_);
  begin(passage, tire.free_, kShortStep);
  const auto errors =
      reduced_errors(tire.rolling_, tire.free_, *passage.state().tire, {1e-4, -1e-4, 5e-3, -1e-2});
  ASSERT_TRUE(errors) << errors.failure().reason;
  EXPECT_LT(std::abs((*errors)[0].error()), most(GetParam(), 0.01, 0.05));
  EXPECT_LT(std::abs((*errors)[1].error()), most(GetParam(), 0.01, 0.05));
  // Farther away the tires differ, and the difference is known.
  for (const int k : {2, 3}) {
    EXPECT_GT(std::abs((*errors)[k].full), 500.0);
    EXPECT_LT(std::abs((*errors)[k].error()), 0.4);
  }
  RollingCase turned = tire.free_.of;
  turned.load.reset();
  turned.drive.reset();
  turned.slip_angle = 0.002;
  const RollingState full = tire.roll(tire.free_, turned);
  const auto reduced = steady_forces(*passage.state().tire, tire.free_.grip, turned);
  ASSERT_TRUE(reduced) << reduced.failure().reason;
  const double Fy = full.forces.force.y() - tire.free_.forces.force.y();
  EXPECT_NEAR(reduced->force.y() - tire.free_.forces.force.y(),
              Fy,
              most(GetParam(), 0.01, 0.08) * std::abs(Fy));
}

TEST_P(ReducedPassageTest, FollowsTheFullTireInSmallMotions) {
  Passing tire(GetParam());
  RollingCase of = tire.free_.of;
  of.drive.reset();
  const RollingState from = tire.roll(tire.free_, of);
  const BothTires heave(tire, from, 40, [](RollingCase at, double time) {
    at.height -= 2.5e-4 * (1.0 - std::cos(2.0 * std::numbers::pi * 60.0 * time));
    return WheelMoment{.of = at};
  });
  EXPECT_LT(heave.error(0), most(GetParam(), 0.03, 0.05));
  EXPECT_LT(heave.error(2), 0.02);
  const BothTires steer(tire, from, 40, [](RollingCase at, double time) {
    at.slip_angle = 0.004 * std::min(1.0, time / 0.01);
    return WheelMoment{.of = at};
  });
  EXPECT_LT(steer.error(1), 0.02);
  EXPECT_LT(steer.error(5), 0.03);
}

INSTANTIATE_TEST_SUITE_P(ElasticAndRelaxing, ReducedPassageTest, testing::Bool());

// Accelerations of the wheel center and turning axes act on the mass of the tire.
TEST(ReducedPassage, FollowsTheFullTireInMovingAxes) {
  Passing tire(true);
  RollingCase of = tire.free_.of;
  of.drive.reset();
  const RollingState from = tire.roll(tire.free_, of);
  const BothTires pushed(tire, from, 24, [](const RollingCase& at, double time) {
    const double share = std::min(1.0, time / 0.01);
    return WheelMoment{.of = at, .acceleration = {4.0 * share, 3.0 * share, -5.0 * share}};
  });
  for (const int row : {0, 1, 2}) EXPECT_LT(pushed.error(row), 0.02) << row;
  const BothTires turned(tire, from, 24, [](const RollingCase& at, double time) {
    const double share = std::min(1.0, time / 0.01);
    return WheelMoment{.of = at,
                       .turning = {0.3 * share, 0.0, 0.4 * share},
                       .turning_rate = time < 0.01 ? Eigen::Vector3d(30.0, 0.0, 40.0)
                                                   : Eigen::Vector3d(0.0, 0.0, 0.0)};
  });
  for (const int row : {3, 5}) EXPECT_LT(turned.error(row), 0.02) << row;
}

TEST(ReducedPassage, SpinsAsTheFullTireUnderAMoment) {
  Passing tire(false);
  tire.start(tire.free_, {.step = kShortStep, .enough = 1e-5});
  ReducedPassage passage(tire.passage_);
  const WheelMoment to{.of = tire.free_.of, .wheel = SpinningWheel{.inertia = 1.0, .moment = 40.0}};
  std::vector<double> full;
  for (int k = 0; k < 60; ++k) full.push_back(tire.advance(to).spin - tire.free_.of.spin);
  begin(passage, tire.free_, kShortStep);
  double largest = 0.0, error = 0.0;
  for (const double spin : full) {
    error = std::max(error, std::abs(go_on(passage, to).spin - tire.free_.of.spin - spin));
    largest = std::max(largest, std::abs(spin));
  }
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(error, 0.02 * largest);
}

// A tire that is gone back to goes on as it did, whatever another did in between.
TEST(ReducedPassage, GoesOnFromAState) {
  Passing tire(true);
  ReducedPassage passage(tire.passage_);
  begin(passage, tire.free_, kShortStep);
  const auto lower = [&](double by) {
    RollingCase of = tire.free_.of;
    of.height -= by;
    return WheelMoment{.of = of};
  };
  go_on(passage, lower(1e-3));
  const ReducedState kept = passage.state();
  const TransientForces once = go_on(passage, lower(2e-3));
  passage.resume(kept);
  ASSERT_TRUE(passage.advance(lower(3e-3), 0.5 * kShortStep));
  passage.resume(kept);
  const TransientForces again = go_on(passage, lower(2e-3));
  EXPECT_EQ(once.force, again.force);
  EXPECT_EQ(once.moment, again.moment);
}

}  // namespace
}  // namespace latsch::fe_tire
