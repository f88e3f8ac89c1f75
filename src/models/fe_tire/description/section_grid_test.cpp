// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/section_grid.h"

#include <gtest/gtest.h>

#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

/// Returns displacements that are cubic along the wall and linear through it.
Eigen::Matrix3Xd field(const SectionGrid& grid) {
  Eigen::Matrix3Xd u(3, grid.nodes());
  Eigen::Index node = 0;
  for (std::size_t i = 0; i < grid.stations.size(); ++i) {
    const double s = grid.stations[i];
    for (const double row : grid.rows[i]) u.col(node++) << s * s * s, row * (1.0 + s), s - row;
  }
  return u;
}

TEST(SectionGrid, HasTheNodesOfTheMesh) {
  const TireDescription tire = reference_tire_b();
  for (const MeshRefinement r : {MeshRefinement(1), MeshRefinement(2, 3, 2)}) {
    EXPECT_EQ(section_grid(tire, r).nodes(), build_mesh(tire, r).nodes_per_sector());
  }
}

TEST(SectionGrid, TakesCubicsAlongAndLinesThroughTheWallToAnotherOne) {
  const TireDescription tire = reference_tire_b();
  const SectionGrid from = section_grid(tire), to = section_grid(tire, {1, 3, 2});
  EXPECT_LT((on_grid(to, from, field(from)) - field(to)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((on_grid(from, from, field(from)) - field(from)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SectionGrid, FromAnotherMeshATireIsInflatedToTheSameState) {
  const TireDescription tire = reference_tire_b();
  FeTire coarse(tire),
      fine(build_mesh(tire, 2), build_materials(tire, 2), {.element = tire.element});
  const auto start = coarse.inflate(tire.pressure);
  ASSERT_TRUE(start.ok());
  const auto near =
      fine.inflate(tire.pressure, on_grid(section_grid(tire, 2), section_grid(tire), start->u));
  const auto alone = fine.inflate(tire.pressure);
  ASSERT_TRUE(near.ok() && alone.ok());
  EXPECT_NEAR(near->growth, alone->growth, 1e-8 * alone->growth);
  EXPECT_LT((near->u - alone->u).norm(), 1e-8 * alone->u.norm());
}

}  // namespace
}  // namespace latsch::fe_tire
