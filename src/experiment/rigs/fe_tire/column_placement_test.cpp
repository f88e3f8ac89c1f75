// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/column_placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/section_columns.h"

namespace latsch {
namespace {

using fe_tire::FeTire;
using fe_tire::TireDescription;

/// Returns a tire with columns of equal length, except that some were moved to the ends of the
/// belts.
TireDescription plain_tire() {
  TireDescription tire = fe_tire::reference_tire_b();
  tire.section.meridional = 24;
  tire.section.sectors = 36;
  tire.section.ends = {0.46};
  tire.cord_model = fe_tire::CordModel::rebar;
  tire.element = fe_tire::ElementKind::solid_shell;
  return with_columns(tire, [] {
    std::vector<double> columns;
    for (int i = 0; i <= 12; ++i) columns.push_back(i / 12.0);
    return columns;
  }());
}

/// Returns the largest error of growth and eight frequencies, compared with a mesh whose elements
/// are divided into four in each direction.
double error_of(const TireDescription& description) {
  const auto quantities = [&](int refinement) {
    FeTire tire(build_mesh(description, refinement),
                build_materials(description, refinement),
                {.element = description.element});
    const auto inflated = tire.inflate(description.pressure);
    EXPECT_TRUE(inflated.ok());
    std::vector<double> values = {inflated->growth};
    const auto modes = tire.modes(*inflated, 8);
    EXPECT_TRUE(modes.ok());
    for (const fe_tire::Mode& mode : *modes) values.push_back(mode.frequency);
    return values;
  };
  const std::vector<double> coarse = quantities(1), fine = quantities(4);
  double error = 0.0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    error = std::max(error, std::abs(coarse[i] / fine[i] - 1.0));
  }
  return error;
}

TEST(ColumnPlacement, CutsTheErrorWithAsManyUnknowns) {
  const TireDescription tire = plain_tire();
  const auto placement = place_columns(tire, {.modes = 8});
  ASSERT_TRUE(placement.ok());
  const TireDescription placed = with_columns(tire, placement->columns);
  EXPECT_LE(placement->unknowns, build_mesh(tire).free_dofs());
  EXPECT_EQ(placement->unknowns, build_mesh(placed).free_dofs());
  EXPECT_LT(error_of(placed), 0.75 * error_of(tire));
  EXPECT_LT(placement->error, placement->error_before);
  EXPECT_FALSE(placement->worst.empty());
}

TEST(ColumnPlacement, EndsColumnsWherePliesEndAndKeepsThemInOrder) {
  TireDescription tire = plain_tire();
  const auto placement = place_columns(tire, {.modes = 4, .rounds = 2});
  ASSERT_TRUE(placement.ok());
  const std::vector<double>& columns = placement->columns;
  EXPECT_EQ(columns.front(), 0.0);
  EXPECT_EQ(columns.back(), 1.0);
  EXPECT_TRUE(std::ranges::is_sorted(columns, std::less_equal<>()));
  EXPECT_TRUE(std::ranges::find(columns, 0.46) != columns.end());
}

TEST(ColumnPlacement, GivesTheSameColumnsAgain) {
  const TireDescription tire = plain_tire();
  const ColumnPlacementSettings settings = {.modes = 4, .rounds = 1};
  EXPECT_EQ(place_columns(tire, settings)->columns, place_columns(tire, settings)->columns);
}

TEST(ColumnPlacement, ChoosesAnEvenNumberOfSectorsWithinTheUnknowns) {
  TireDescription tire = plain_tire();
  tire.section.sectors = 60;  // too many for its few columns
  const int unknowns = build_mesh(tire).free_dofs();
  const auto alone = place_columns(tire, {.modes = 8, .rounds = 3});
  const auto both = place_columns(tire, {.modes = 8, .rounds = 3, .choose_sectors = true});
  ASSERT_TRUE(alone.ok() && both.ok());
  EXPECT_EQ(alone->sectors, 60);
  EXPECT_EQ(both->sectors % 2, 0);
  EXPECT_LE(both->unknowns, unknowns);
  EXPECT_LE(both->error, alone->error);
}

/// Largest error of the vertical force and six modes on the ground, against elements split into
/// three around and along.
double loaded_error_of(const TireDescription& description, double deflection) {
  const auto quantities = [&](const fe_tire::MeshRefinement& refinement) {
    FeTire tire(build_mesh(description, refinement),
                build_materials(description, refinement),
                {.element = description.element});
    const auto inflated = tire.inflate(description.pressure);
    EXPECT_TRUE(inflated.ok());
    const auto pressed = tire.press(*inflated, {}, {deflection});
    EXPECT_TRUE(pressed.ok());
    std::vector<double> values = {tire.stand(pressed->back()).force.z()};
    const auto modes = tire.modes(pressed->back(), 6);
    EXPECT_TRUE(modes.ok());
    for (const fe_tire::Mode& mode : *modes) values.push_back(mode.frequency);
    return values;
  };
  const std::vector<double> coarse = quantities(1), fine = quantities({3, 3, 1});
  double error = 0.0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    error = std::max(error, std::abs(coarse[i] / fine[i] - 1.0));
  }
  return error;
}

TEST(ColumnPlacement, ExchangesColumnsByWhatIsSeenOnTheGround) {
  const TireDescription tire = plain_tire();
  constexpr double kDeflection = 0.012;
  ColumnPlacementSettings settings = {.modes = 6, .rounds = 1, .choose_sectors = true};
  const auto unloaded = place_columns(tire, settings);
  settings.deflection = kDeflection;
  const auto loaded = place_columns(tire, settings);
  ASSERT_TRUE(unloaded.ok() && loaded.ok());
  const auto with = [&](const ColumnPlacement& placement) {
    TireDescription placed = with_columns(tire, placement.columns);
    placed.section.sectors = placement.sectors;
    return placed;
  };
  EXPECT_LE(loaded->unknowns, build_mesh(tire).free_dofs());
  EXPECT_EQ(loaded->unknowns, build_mesh(with(*loaded)).free_dofs());
  EXPECT_LT(loaded->error, loaded->error_before);
  EXPECT_LT(loaded_error_of(with(*loaded), kDeflection),
            loaded_error_of(with(*unloaded), kDeflection));
}

TEST(ColumnPlacement, TooFewUnknownsAreAFailureWithTheFewest) {
  const auto placement = place_columns(plain_tire(), {.unknowns = 500, .modes = 4, .rounds = 1});
  ASSERT_FALSE(placement.ok());
  EXPECT_NE(placement.failure().reason.find("more than the 500 allowed"), std::string::npos)
      << placement.failure().reason;
}

TEST(ColumnPlacement, ADeflectionIntoTheRimIsAFailureBeforeAnyRound) {
  int rounds = 0;
  const auto placement = place_columns(
      plain_tire(), {.modes = 4, .deflection = 0.3}, [&](const std::string&) { ++rounds; });
  ASSERT_FALSE(placement.ok());
  EXPECT_NE(placement.failure().reason.find("rim"), std::string::npos)
      << placement.failure().reason;
  EXPECT_EQ(rounds, 0);
}

TEST(ColumnPlacement, ATireThatCannotBeInflatedIsAFailure) {
  TireDescription tire = plain_tire();
  tire.pressure = 1e9;
  const auto placement = place_columns(tire, {.modes = 4, .rounds = 1});
  ASSERT_FALSE(placement.ok());
  EXPECT_FALSE(placement.failure().reason.empty());
}

}  // namespace
}  // namespace latsch
