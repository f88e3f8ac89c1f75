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
  const auto file = std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/ring_tires/passenger_205_55R16.toml";
  return ring_tire::RingTire(ring_tire::read_ring_tire(Document::read(file).root()));
}

// Springs in a row, sidewall and tread: the patch holds the tire along x and y, no stiffer than the
// sidewall alone would be; a passenger tire is stiffer along than across.
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

}  // namespace
}  // namespace latsch::experiment
