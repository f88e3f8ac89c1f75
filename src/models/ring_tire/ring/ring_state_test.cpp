// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/ring_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/profile_road.h"
#include "models/tire/free_wheel.h"

namespace latsch::ring_tire {
namespace {

using testing::HasSubstr;

constexpr double kStep = 5e-4, kSpeed = 10.0;

/// Returns a ring whose sidewall, tread and, if they can bend, sections have a memory.
RingParameters with_memory(double bending_across) {
  RingParameters ring = passenger_ring();
  ring.sidewall.radial.dynamic_stiffening = 0.2;
  ring.sidewall.radial.friction_stiffening = 0.1;
  ring.sidewall.radial.friction_force = 500.0;
  ring.belt.bending_across = bending_across;
  return ring;
}

WheelMotion at_step(int i) {
  WheelMotion motion;
  motion.center = {i * kStep * kSpeed, 0.0, 0.296};
  motion.velocity.x() = kSpeed;
  motion.spin_rate = kSpeed / 0.308;
  motion.spin = i * kStep * motion.spin_rate;
  return motion;
}

class RingStateOn : public testing::TestWithParam<double> {
 protected:
  /// Returns a tire that has rolled 40 steps and is in front of a cleat.
  RingTire before_the_cleat() {
    RingTire tire(with_memory(GetParam()));
    EXPECT_TRUE(tire.settle(at_step(0), road_, 0.0));
    for (int i = 1; i <= 40; ++i) EXPECT_TRUE(tire.advance(at_step(i), road_, i * kStep, kStep));
    return tire;
  }
  /// Returns the forces of the next steps. Each step is tried twice before it is accepted.
  std::vector<HubForces> over_the_cleat(RingTire& tire, RingState state) {
    std::vector<HubForces> forces;
    for (int i = 41; i <= 60; ++i) {
      const auto lost = tire.trial(state, at_step(i + 1), road_, (i + 1) * kStep, 2.0 * kStep);
      EXPECT_TRUE(lost);
      const auto step = tire.trial(state, at_step(i), road_, i * kStep, kStep);
      EXPECT_TRUE(step) << step.failure().reason;
      if (!step) break;
      state = step->state;
      forces.push_back(step->hub);
    }
    return forces;
  }

  road::ProfileRoad road_ = road::cleat_road(0.3, 0.015, 0.03, 0.005);
};

INSTANTIATE_TEST_SUITE_P(Sections, RingStateOn, testing::Values(0.0, 8.0));

TEST_P(RingStateOn, StepsFromAStateAreTheSameBitsInAnyTire) {
  RingTire tire = before_the_cleat(), other(with_memory(GetParam()));
  const RingState state = tire.state();
  const auto forces = over_the_cleat(tire, state), again = over_the_cleat(other, state);
  ASSERT_EQ(forces.size(), 20u);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    EXPECT_EQ(forces[i].force, again[i].force) << i;
    EXPECT_EQ(forces[i].moment, again[i].moment) << i;
  }
  EXPECT_TRUE(tire.state() == other.state());
  EXPECT_FALSE(tire.state() == state);
}

TEST_P(RingStateOn, ComesBackAsItWas) {
  RingTire tire = before_the_cleat();
  const RingState state = tire.state();
  for (int i = 41; i <= 60; ++i) ASSERT_TRUE(tire.advance(at_step(i), road_, i * kStep, kStep));
  EXPECT_FALSE(tire.state() == state);
  tire.restore(state);
  EXPECT_TRUE(tire.state() == state);
  EXPECT_TRUE(tire.contacts().empty());
}

// A trial step may fail: far into the ground, in one part or in ten, or to a position that is not a
// number. The state must then be unchanged.
TEST_P(RingStateOn, IsAsItWasAfterAStepThatFails) {
  RingTire tire = before_the_cleat();
  const RingState state = tire.state();
  WheelMotion in_the_ground = at_step(41), nowhere = at_step(41);
  in_the_ground.center.z() = -5.0;
  nowhere.center.x() = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [motion, step] : {std::pair{in_the_ground, kStep},
                                     {in_the_ground, 20.0 * kStep},
                                     {nowhere, kStep},
                                     {nowhere, 20.0 * kStep}}) {
    const auto hub = tire.advance(motion, road_, 41 * kStep, step);
    ASSERT_FALSE(hub);
    EXPECT_FALSE(hub.failure().reason.empty());
    EXPECT_TRUE(tire.state() == state);
  }
  EXPECT_TRUE(tire.advance(at_step(41), road_, 41 * kStep, kStep));
}

// A road whose height is not a number from x = 0.3 m on.
class RoadThatEnds final : public road::Road {
 public:
  road::GroundPoint at(double x, double y, double time) const override {
    road::GroundPoint ground;
    ground.height = height(x, y, time);
    return ground;
  }
  double height(double x, double, double) const override {
    return x < 0.3 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  }
};

TEST_P(RingStateOn, SaysWhatNoTireCanFollow) {
  RingTire tire = before_the_cleat();
  const RingState state = tire.state();
  WheelMotion spun = at_step(41), there = at_step(41);
  spun.spin_rate = std::numeric_limits<double>::infinity();
  const auto refused = [&](const WheelMotion& motion, const road::Road& road, double step) {
    const auto hub = tire.advance(motion, road, 41 * kStep, step);
    EXPECT_TRUE(tire.state() == state);
    return hub ? "" : hub.failure().reason;
  };
  EXPECT_THAT(refused(spun, road_, kStep), HasSubstr("the wheel's motion is not finite"));
  for (const double step : {0.0, -kStep, 1e300, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(refused(there, road_, step), HasSubstr("a step of the ring needs a time"));
  EXPECT_THAT(refused(there, RoadThatEnds(), kStep), HasSubstr("the road has no height"));
  const auto refused_free = [&](WheelMotion motion, double step) {
    FreeWheel wheel;
    const auto hub = tire.advance_free(motion, wheel, road_, 41 * kStep, step);
    EXPECT_TRUE(tire.state() == state);
    return hub ? "" : hub.failure().reason;
  };
  spun = at_step(41);
  spun.center.z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refused_free(spun, kStep), HasSubstr("the wheel's motion is not finite"));
  for (const double step : {0.0, -kStep, 1e300, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(refused_free(at_step(41), step), HasSubstr("a step of the ring needs a time"));
}

TEST_P(RingStateOn, IsAsItWasWhereItFindsNoRest) {
  RingTire tire = before_the_cleat();
  const RingState state = tire.state();
  WheelMotion over_the_hole = at_step(0), in_the_ground = at_step(0);
  over_the_hole.center.x() = 0.3;
  in_the_ground.center.z() = 0.02;
  const auto beyond = tire.settle(over_the_hole, RoadThatEnds(), 0.0);
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.failure().reason, HasSubstr("the road has no height"));
  EXPECT_TRUE(tire.state() == state);
  EXPECT_FALSE(tire.settle(in_the_ground, road_, 0.0));
  EXPECT_TRUE(tire.state() == state);
}

// In such short steps the rounding of positions causes inertia forces larger than the tolerance.
// They occur if a simulation ends at a given time.
TEST_P(RingStateOn, TakesShortStepsFarAway) {
  for (const auto& [way, step] : {std::pair{0.0, 1e-9}, {1e4, 1e-7}, {0.0, 1e-12}}) {
    RingTire tire(with_memory(GetParam()));
    const road::ProfileRoad road = road::cleat_road(way + 0.3, 0.015, 0.03, 0.005);
    WheelMotion motion = at_step(0);
    motion.center.x() += way;
    ASSERT_TRUE(tire.settle(motion, road, 0.0));
    double before = 0.0;
    for (int i = 1; i <= 3; ++i) {
      motion.center += step * motion.velocity;
      motion.spin += step * motion.spin_rate;
      const auto hub = tire.advance(motion, road, i * step, step);
      ASSERT_TRUE(hub) << way << ", " << step << ": " << hub.failure().reason;
      if (i > 1) {
        EXPECT_NEAR(hub->force.z(), before, 1.0) << way << ", " << step;
      }
      before = hub->force.z();
    }
  }
}

// The only part of the tread that the state may contain is the contact patch, so that the state is
// small.
TEST_P(RingStateOn, IsSmall) {
  const RingState state = before_the_cleat().state();
  EXPECT_GT(state.tread.tips()->columns.size(), 400u);
  EXPECT_LT(state.tread.tips()->columns.size(), 4u * 80u * 6u * 16u / 4u);
}

}  // namespace
}  // namespace latsch::ring_tire
