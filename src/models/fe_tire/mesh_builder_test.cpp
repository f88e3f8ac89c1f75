// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "models/fe_tire/reference_tires.h"

namespace latsch::fe_tire {
namespace {

// [Hempel & Oertel 2016], table of both tires.
TEST(MeshBuilder, TiresAAndBHaveTheElementsAndFreedomsOfThePaper) {
  const Mesh a = build_mesh(reference_tire_a()), b = build_mesh(reference_tire_b());
  EXPECT_EQ(a.element_count(), 7020);
  EXPECT_EQ(a.free_dofs(), 27000);
  EXPECT_EQ(b.element_count(), 3480);
  EXPECT_EQ(b.free_dofs(), 15480);
}

TEST(Mesh, SectorsAreCountedFromTheBottomTowardTheFront) {
  const Mesh mesh = build_mesh(reference_tire_b());
  const Eigen::Vector3d quarter = mesh.frame(mesh.sectors / 4) * Eigen::Vector3d(0, 0, -1);
  EXPECT_NEAR((quarter - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-15);
  Eigen::Matrix3d round = Eigen::Matrix3d::Identity();
  for (int s = 0; s < mesh.sectors; ++s) round = mesh.sector_rotation() * round;
  EXPECT_NEAR((round - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-13);
  // Crown of the reference line and tread, less the sag of half an element column.
  EXPECT_NEAR(mesh.outer_radius(), 0.310 + 0.009, 5e-5);
}

TEST(Mesh, EtaRunsFromTheLeftBeadAndZetaOutward) {
  const Mesh mesh = build_mesh(reference_tire_b());
  const auto X = mesh.coordinates(mesh.elements[2 * 14]);  // at the crown
  EXPECT_GT(X(0, 1), X(0, 0));
  EXPECT_LT(X(1, 3), X(1, 0));
  EXPECT_LT(X(2, 4), X(2, 0));
}

TEST(Mesh, AnInvertedElementIsNamedWithItsPlace) {
  Mesh mesh = build_mesh(reference_tire_b());
  std::swap(mesh.elements[7].node[0], mesh.elements[7].node[4]);
  try {
    check(mesh);
    FAIL() << "an inverted element passed";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("element 7"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("r = "), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace latsch::fe_tire
