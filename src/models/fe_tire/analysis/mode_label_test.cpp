// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/analysis/mode_label.h"

#include <gtest/gtest.h>

namespace latsch::fe_tire {
namespace {

/// The shape has two nodes: a heavy one that moves along the axis, and a light one, as on a finer
/// mesh, that moves farther in the wheel plane.
TEST(ModeLabel, KineticEnergyWeighsMotionByMass) {
  Eigen::VectorXcd phi(6), M_phi(6);
  phi << 0.0, 1.0, 0.0, 0.0, 0.0, std::complex<double>(0.0, 2.0);
  Eigen::VectorXd mass(6);
  mass << 5.0, 5.0, 5.0, 0.1, 0.1, 0.1;
  M_phi = mass.asDiagonal() * phi;
  const Eigen::Vector3d energy = kinetic_energy(phi, M_phi);
  EXPECT_DOUBLE_EQ(energy.x(), 0.0);
  EXPECT_DOUBLE_EQ(energy.y(), 5.0);
  EXPECT_DOUBLE_EQ(energy.z(), 0.4);
  EXPECT_EQ(type_of(2, energy), ModeType::lateral);
}

/// Returns a mesh without sectors that consists of four nodes on a square in the plane y = 0.
Mesh square() {
  Mesh mesh;
  mesh.X.resize(3, 4);
  mesh.X << 1.0, -1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 2.0, 2.0, 3.0, 3.0;
  return mesh;
}

TEST(ModeLabel, PhaseOfAMeshWithoutSectorsIsByWhereItsNodesAre) {
  Eigen::Matrix3Xd shape(3, 4);
  shape << 1.0, -1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0;
  EXPECT_EQ(phase_of(square(), shape), 's');
  shape.col(1) *= -1.0;
  shape.col(3) *= -1.0;
  EXPECT_EQ(phase_of(square(), shape), 'a');
}

TEST(ModeLabel, AMeshThatIsNotItsMirrorImageHasNoPhases) {
  Mesh mesh = square();
  mesh.X(0, 0) = 1.1;
  EXPECT_EQ(phase_of(mesh, Eigen::Matrix3Xd::Ones(3, 4)), ' ');
}

}  // namespace
}  // namespace latsch::fe_tire
