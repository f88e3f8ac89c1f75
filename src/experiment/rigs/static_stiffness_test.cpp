// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/static_stiffness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::experiment {
namespace {

ring_tire::RingTire example_tire() {
  const auto file =
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/ring_tires/passenger_205_55R16.toml";
  return ring_tire::RingTire(ring_tire::read_ring_tire(Document::read(file).root()));
}

// Sidewall and tread are springs in series: the patch holds the tire along x and y, and the
// stiffness is at most that of the sidewall alone; a passenger tire is stiffer along than across.
TEST(StaticStiffness, IsThatOfSidewallAndTreadInSeries) {
  ring_tire::RingTire tire = example_tire();
  const auto& ring = tire.parameters();
  const double circumference = 2.0 * M_PI * ring.belt.radius;
  const auto in = [&](Direction direction) {
    const auto found = stiffness(tire, {.direction = direction});
    EXPECT_TRUE(found) << found.failure().reason;
    return found ? *found : 0.0;
  };
  const double along = in(Direction::longitudinal), across = in(Direction::lateral),
               down = in(Direction::vertical);
  EXPECT_GT(along, across);
  EXPECT_LT(across, circumference * ring.sidewall.lateral.stiffness);
  EXPECT_GT(across, 3e4);
  EXPECT_GT(down, 1e5);
  EXPECT_LT(down, 4e5);
  EXPECT_GT(in(Direction::torsional), 500.0);
}

// The steps of a flexible ring end at a residual of 0.1 N at a node, which a travel of 10 um does
// not exceed: the belt would not move, and the tread's blocks alone would be measured.
TEST(StaticStiffness, ATravelThatTheStepsDoNotResolveFails) {
  ring_tire::RingTire tire = example_tire();
  StandingTest test{.load = 4000.0, .directions = {Direction::lateral}, .travel = 1e-5};
  const auto found = stand(tire, test);
  ASSERT_FALSE(found);
  EXPECT_NE(found.failure().reason.find("less than the steps of this tire resolve"),
            std::string::npos)
      << found.failure().reason;
  test.travel = 2e-4;
  EXPECT_TRUE(stand(tire, test));
}

double load_on(ring_tire::RingTire& tire, double deflection, const std::optional<Cleat>& cleat) {
  const auto load = load_at(tire, deflection, cleat);
  EXPECT_TRUE(load) << load.failure().reason;
  return load ? *load : 0.0;
}

// A cleat longer than the contact patch and wider than the tread is equivalent to ground at the
// height of the cleat.
TEST(StaticStiffness, OnACleatAllAroundIsThatOnTheGround) {
  ring_tire::RingTire tire = example_tire();
  const double flat = load_on(tire, 0.02, {});
  for (const double angle : {0.0, 0.5, M_PI / 2.0}) {
    const Cleat plateau{.height = 0.02, .length = 1.5, .angle = angle};
    EXPECT_NEAR(load_on(tire, 0.02, plateau), flat, 1e-3 * flat) << angle;
  }
}

// A low cleat shares the load with the ground beside it.
TEST(StaticStiffness, FallsWithTheCleatThatCarries) {
  ring_tire::RingParameters ring = example_tire().parameters();
  ring.tread.lines = 24;  // a bar along the road touches only some lines
  ring_tire::RingTire tire(ring);
  const double flat = load_on(tire, 0.02, {});
  for (const double angle : {0.0, M_PI / 2.0}) {
    double last = flat;
    for (const double length : {0.1, 0.05, 0.02}) {
      const double load =
          load_on(tire, 0.02, Cleat{.height = 0.03, .length = length, .angle = angle});
      EXPECT_LT(load, last) << length << " m at " << angle;
      last = load;
    }
    EXPECT_GT(last, 0.0);
    const Cleat low{.height = 1e-5, .length = 0.05, .angle = angle};
    EXPECT_NEAR(load_on(tire, 0.02, low), flat, 5e-3 * flat) << angle;
  }
}

}  // namespace
}  // namespace latsch::experiment
