// SPDX-License-Identifier: Apache-2.0
// Tests that relaxing slip is distinguished from forces that vary with the rotation of a wheel, on
// sampled forces in closed form and on a car.
#include "models/car/falling_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/car/race_car_testing.h"
#include "models/road/plane_road.h"

namespace latsch::car {
namespace {

using std::numbers::pi;

constexpr double kStep = 0.012;  // m, as in the rounds of a car
// Length of a segment, m. It is nearly two steps, so its force beats.
constexpr double kSegment = 0.024;

/// Vertical force of a tire at x (m) that has rolled a distance (m): slip that relaxes, and
/// segments that pass.
struct RollingForce {
  double transient = 0.0, length = 1.0;                   // N, m
  double unround = 0.0, segment = kSegment, phase = 0.0;  // N, m, rad

  double at(double x, double rolled) const {
    return transient * std::exp(-rolled / length) +
           unround * std::cos(2.0 * pi * x / segment + phase);
  }
};

/// Returns the ranges of a tire that rolls to x = 0, as a car's tires roll to their start.
FallingRanges rolled(const RollingForce& force, int rounds, int steps) {
  FallingRanges ranges;
  for (int round = 0; round < rounds; ++round) {
    for (int i = 1; i <= steps; ++i)
      if (2 * i > steps) {
        const int taken = round * steps + i;
        ranges.add({0.0, 0.0, force.at(kStep * (taken - rounds * steps), kStep * taken)});
      }
    ranges.end_round();
  }
  return ranges;
}

/// Returns the rounds after which the tire counts as steady if they are doubled from 12 to 384, as
/// a car doubles them; 0 if it never does.
int steady_after(const RollingForce& force, int steps) {
  for (int rounds = 12; rounds <= 384; rounds *= 2)
    if (rolled(force, rounds, steps).still_falling(0.003) == 0.0) return rounds;
  return 0;
}

// A segment of nearly two steps is sampled at phases that change slowly, so the ranges of the
// rounds go up and down over many rounds. A single range may then be much smaller than the one of
// three rounds before, after any number of rounds.
TEST(FallingRanges, ForcesThatBeatAreSteadyAtAnyPhase) {
  for (const double segment : {0.02398, 0.02399, 0.0239, 0.0241, 0.0237, 0.0481})
    for (int phase = 0; phase < 32; ++phase)
      for (const int steps : {25, 150}) {
        const RollingForce beating{.unround = 0.1, .segment = segment, .phase = pi / 16.0 * phase};
        EXPECT_GT(steady_after(beating, steps), 0) << segment << " m, phase " << phase;
      }
}

// The share of a relaxing range that remains after three rounds is exp(-3 L / s).
TEST(FallingRanges, SlipThatRelaxesFallsAfterAnyNumberOfRounds) {
  for (const int rounds : {12, 24, 48, 96}) {
    const auto falling = [&](double length) {
      return rolled({.transient = 1e6, .length = length}, rounds, 25).still_falling(0.0);
    };
    EXPECT_GT(falling(8.0), 0.0) << rounds;
    EXPECT_EQ(falling(9.0), 0.0) << rounds;
  }
}

TEST(FallingRanges, SlipThatRelaxesIsSeenBesideForcesThatBeat) {
  const RollingForce both{.transient = 100.0, .length = 3.0, .unround = 0.1, .segment = 0.0237};
  EXPECT_GT(rolled(both, 12, 25).still_falling(0.003), 0.0);
  const int rounds = steady_after(both, 25);
  ASSERT_GT(rounds, 0);
  // When the tire counts as steady, the slip left is less than the segments' force.
  EXPECT_LT(100.0 * std::exp(-rounds * 25 * kStep / 3.0), 0.1);
}

/// A spring tire whose force also varies with the distance rolled, as that of a belt of segments.
class SegmentedTire final : public Tire {
 public:
  SegmentedTire(double unround, double segment)
      : spring_({0.235, 117e3, 300.0}), unround_(unround), segment_(segment) {}
  double free_radius() const override { return spring_.free_radius(); }
  Result<HubForces> settle(const WheelMotion& motion,
                           const road::Road& road,
                           double time) override {
    return spring_.settle(motion, road, time);
  }
  Result<HubForces> advance(const WheelMotion& motion,
                            const road::Road& road,
                            double time,
                            double step) override {
    auto hub = spring_.advance(motion, road, time, step);
    if (hub) hub->force.z() += unround_ * std::cos(2.0 * pi * motion.center.x() / segment_);
    return hub;
  }
  Result<HubForces> advance_free(WheelMotion& motion,
                                 FreeWheel& wheel,
                                 const road::Road& road,
                                 double time,
                                 double step) override {
    return advance_by_trials(*this, motion, wheel, road, time, step);
  }
  std::unique_ptr<Tire> clone() const override { return std::make_unique<SegmentedTire>(*this); }

 private:
  SpringTire spring_;
  double unround_, segment_;
};

// Segments change the force of a tire by 0.2 N of 700 N however far it has rolled; the car starts
// nevertheless, at every speed.
TEST(CarOnSegmentedTires, StartsAtEverySpeed) {
  for (const double speed : {20.0, 50.0, 60.0, 70.0})
    for (const double segment : {0.0237, 0.0239, 0.02399, 0.0241}) {
      Tires tires;
      for (auto& tire : tires) tire = std::make_unique<SegmentedTire>(0.1, segment);
      auto car = Car::make(race_car(true), std::move(tires));
      ASSERT_TRUE(car) << car.failure().reason;
      const auto state = (*car)->settle(road::PlaneRoad{}, speed, {});
      EXPECT_TRUE(state) << speed << " m/s, " << segment
                         << " m: " << (state ? "" : state.failure().reason);
    }
}

}  // namespace
}  // namespace latsch::car
