// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/fine_tread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/section_columns.h"

namespace latsch::fe_tire {
namespace {

constexpr TreadElements kLargest{.around = 9e-3, .across = 10e-3};

TireDescription fine(const TireDescription& tire, const TreadElements& largest = kLargest) {
  return with_split_tread(tire, split_of(tire, largest));
}

/// Returns the circumferential length of the tread's elements in a sector, m.
double arc(const Mesh& mesh, int sector) {
  return (mesh.angle(sector + 1) - mesh.angle(sector)) * mesh.outer_radius();
}

TEST(FineTread, HasNoLongerElementsWhereItTouches) {
  const Mesh mesh = build_mesh(fine(reference_tire_b()));
  double angle = 0.0;
  for (int s = 0; angle < 0.28; angle = mesh.angle(++s)) {
    EXPECT_LE(arc(mesh, s), (angle < 0.05 ? 0.5 : 1.0) * kLargest.around * 1.0001) << s;
  }
  int below = 0;
  for (const Element& element : mesh.elements) {
    if (!element.tread) continue;
    const auto corners = mesh.coordinates(element);
    EXPECT_LE((corners.col(7) - corners.col(4)).norm(), 1.15 * kLargest.across);
    ++below;
  }
  EXPECT_GT(below, 0);
}

TEST(FineTread, LeavesWallAndTopOfTheRingAsTheyAre) {
  const TireDescription tire = reference_tire_b(), split = fine(tire);
  const auto behind = [&](const TireDescription& of) {
    std::vector<double> columns = columns_of(of.section);
    std::erase_if(columns, [&](double q) { return q < of.section.tread_to; });
    return columns;
  };
  const std::vector<double> wall = behind(tire), same = behind(split);
  ASSERT_GE(same.size(), wall.size());
  EXPECT_TRUE(std::equal(wall.rbegin(), wall.rend() - 1, same.rbegin(), [](double a, double b) {
    return std::abs(a - b) < 1e-12;
  }));
  const Mesh mesh = build_mesh(split), own = build_mesh(tire);
  EXPECT_NEAR(mesh.angle(mesh.sectors / 2) - mesh.angle(mesh.sectors / 2 - 1),
              own.angle(own.sectors / 2) - own.angle(own.sectors / 2 - 1),
              1e-12);
  EXPECT_NEAR(mesh.angle(mesh.sectors), 2.0 * std::numbers::pi, 1e-12);
}

// If a tire has two meshes, the one with a finer tread must agree better with the mesh in which all
// elements are split.
TEST(FineTread, IsTheSameTire) {
  const TireDescription tire = reference_tire_b();
  FeTire own(tire), split(fine(tire)), finest(build_mesh(tire, 3), build_materials(tire, 3));
  const double mass = finest.total_mass();
  EXPECT_LT(std::abs(split.total_mass() - mass), std::abs(own.total_mass() - mass));
  const auto grown = finest.inflate(tire.pressure), grown_split = split.inflate(tire.pressure);
  ASSERT_TRUE(grown && grown_split);
  EXPECT_NEAR(grown_split->growth / grown->growth, 1.0, 0.02);
  EXPECT_NEAR(grown_split->radius / grown->radius, 1.0, 1e-3);
}

void expect_same(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.sectors, b.sectors);
  ASSERT_EQ(a.X.cols(), b.X.cols());
  EXPECT_TRUE(a.X.isApprox(b.X, 1e-12));
  for (int s = 0; s < a.sectors; ++s) EXPECT_NEAR(a.angle(s), b.angle(s), 1e-12) << s;
}

TEST(FineTread, SplitsNothingThatIsShortEnough) {
  const TireDescription tire = reference_tire_b(), once = fine(tire);
  expect_same(build_mesh(fine(once)), build_mesh(once));
  // An even number of columns, with one column on either side of the crown.
  TireDescription even = tire;
  even.section.meridional += even.section.meridional % 2;
  expect_same(build_mesh(fine(even, {.around = 1.0, .across = 1.0})), build_mesh(even));
}

TEST(FineTread, IsTheSameOnBothSidesOfAnOddNumberOfSectors) {
  TireDescription tire = reference_tire_b();
  tire.section.sectors = 45;
  tire.section.sector_zones.clear();
  const Mesh mesh = build_mesh(fine(tire));
  for (int s = 0; s <= mesh.sectors; ++s) {
    EXPECT_NEAR(mesh.angle(mesh.sectors - s), 2.0 * std::numbers::pi - mesh.angle(s), 1e-12) << s;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
