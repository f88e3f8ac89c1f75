// SPDX-License-Identifier: Apache-2.0
#include "correlation/basic_data/fe_ring_data.h"

#include <gtest/gtest.h>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::correlation {
namespace {

/// Tire B on a mesh of a few hundred elements: coarse, but all its physics.
fe_tire::FeTire coarse_tire() {
  auto tire = fe_tire::reference_tire_b();
  tire.section.meridional = 14;
  tire.section.sectors = 24;
  return {fe_tire::build_mesh(tire), fe_tire::build_materials(tire)};
}

// What the ring is asked to show is what the FE tire shows itself.
TEST(FeRingData, AsksForTheLoadsAndFrequenciesOfTheFeTire) {
  constexpr double kPressure = 2.6e5;
  auto tire = coarse_tire();
  const auto known = Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                    "studies/ring_tires/passenger_205_55R16.toml");
  const auto data = ring_data_of(tire, kPressure, known);
  ASSERT_TRUE(data) << data.failure().reason;
  ASSERT_EQ(data->targets.size(), 9u);
  const auto inflated = tire.inflate(kPressure);
  ASSERT_TRUE(inflated);
  const auto loaded = tire.load(*inflated, {data->targets[1].deflection}, {});
  ASSERT_TRUE(loaded);
  EXPECT_NEAR(data->targets[1].value, loaded->curve[0].Fz, 1e-3 * loaded->curve[0].Fz);
  const auto modes = tire.modes(*inflated, 6);
  ASSERT_TRUE(modes);
  for (const fe_tire::Mode& mode : *modes) {
    if (mode.type != fe_tire::ModeType::torsional || mode.n != 0) continue;
    EXPECT_NEAR(data->targets[3].value, mode.frequency, 1e-6 * mode.frequency);
    EXPECT_FALSE(data->targets[3].lateral);
  }
  EXPECT_TRUE(data->targets[5].lateral);
}

}  // namespace
}  // namespace latsch::correlation
