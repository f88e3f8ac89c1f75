// SPDX-License-Identifier: Apache-2.0
// A tire that is stable on its mesh stays stable on finer meshes: inflated, every circumferential
// number is stable up to waves of one element, and so is the path onto the ground. Only columns are
// refined, which leaves elements up to ten times longer around the circumference than along the
// wall. Below belts that become narrower as they grow, the carcass is in compression
// (hex8_rebar.cpp, (3)).
#include <gtest/gtest.h>

#include <filesystem>

#include "base/document.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/tire_description.h"

namespace latsch {
namespace {

using namespace fe_tire;

TireDescription shipped(const char* name) {
  return read_tire(
      Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/tires" / name).root());
}

class RefinedTires : public testing::TestWithParam<const char*> {};

TEST_P(RefinedTires, AnInflatedTireHoldsInEveryCircumferentialNumber) {
  // Number of modes of each circumferential number in the first search; all but two of them are
  // pairs.
  constexpr int kOfEach = 3;
  const TireDescription description = shipped(GetParam());
  for (const int along : {2, 4}) {
    const MeshRefinement refinement(1, along, 1);
    FeTire tire(build_mesh(description, refinement), build_materials(description, refinement));
    const auto inflated = tire.inflate(description.pressure);
    ASSERT_TRUE(inflated) << inflated.failure().reason;
    // With this number of modes the search has to include all circumferential numbers.
    const auto modes = tire.modes(*inflated, kOfEach * tire.mesh().sectors);
    EXPECT_TRUE(modes) << along << " times as many columns: " << modes.failure().reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Tires,
                         RefinedTires,
                         testing::Values("passenger_205_55R16.toml",
                                         "passenger_225_50R16.toml",
                                         "passenger_235_45R20.toml",
                                         "race_16x7.5-10.toml"));

TEST(RefinedTire, ATireOnTheGroundKeepsItsEquilibrium) {
  const TireDescription description = shipped("passenger_205_55R16.toml");
  const MeshRefinement refinement(1, 3, 1);
  FeTire tire(build_mesh(description, refinement), build_materials(description, refinement));
  const auto inflated = tire.inflate(description.pressure);
  ASSERT_TRUE(inflated) << inflated.failure().reason;
  const auto states = tire.press(*inflated, Ground{}, {0.005});
  EXPECT_TRUE(states) << states.failure().reason;
  EXPECT_EQ(tire.counts().shifts, 0);
}

}  // namespace
}  // namespace latsch
