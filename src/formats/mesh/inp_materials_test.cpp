// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/inp_materials.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace latsch::formats {
namespace {

using fe_tire::Matrix6;

/// Returns the stiffness matrix of a material with this law in an orientation rotated about an axis
/// (0: no rotation).
Matrix6 stiffness_of(const std::string& law, int axis = 0, double angle = 0.0) {
  const std::string turned = axis == 0 ? "" : fmt::format("{},{}\n", axis, angle);
  const InpDeck deck = parse_inp("** units: m, N, kg\n*MATERIAL,NAME=M\n" + law +
                                     "\n*DENSITY\n1100\n*ORIENTATION,NAME=O,SYSTEM=CYLINDRICAL\n"
                                     "0,0,0,0,0,1\n" +
                                     turned,
                                 "law.inp");
  const fe_tire::Solid solid = solid_from(deck, deck.materials.at("M"), &deck.orientations.at("O"));
  return std::get<fe_tire::StVenantKirchhoff>(solid.law).D;
}

std::string engineering(double E1, double E2, double nu, double G) {
  return fmt::format(
      "*ELASTIC,TYPE=ENGINEERING CONSTANTS\n{0},{1},{1},{2},{2},{2},{3},{3}\n{3}", E1, E2, nu, G);
}

TEST(InpMaterials, IsotropicConstantsAreTheSameInEveryForm) {
  const double E = 6e6, nu = 0.45, G = E / (2.0 * (1.0 + nu));
  const double lambda = 2.0 * G * nu / (1.0 - 2.0 * nu), a = lambda + 2.0 * G;
  const Matrix6 D = stiffness_of(fmt::format("*ELASTIC\n{},{}", E, nu));
  EXPECT_LT((stiffness_of(engineering(E, E, nu, G)) - D).norm(), 1e-12 * D.norm());
  EXPECT_LT((stiffness_of(fmt::format(
                 "*ELASTIC,TYPE=ORTHO\n{0},{1},{0},{1},{1},{0},{2},{2}\n{2}", a, lambda, G)) -
             D)
                .norm(),
            1e-12 * D.norm());
  // Rotation does not change an isotropic law.
  EXPECT_LT((stiffness_of(engineering(E, E, nu, G), 2, 33.0) - D).norm(), 1e-12 * D.norm());
}

// The expected modulus of a lamina at an angle to its fibers is that of [Jones, Mechanics of
// Composite Materials, 2nd ed. 1999, eq. 2.97]:
//   1/E_x = cos^4/E1 + (1/G12 - 2 nu12/E1) sin^2 cos^2 + sin^4/E2
TEST(InpMaterials, ALaminaTurnedByAnAngleHasTheModulusOfTheBooks) {
  const double E1 = 2e9, E2 = 1e7, nu = 0.3, G = 4e6, angle = 24.0;
  const double c = std::cos(angle * M_PI / 180.0), s = std::sin(angle * M_PI / 180.0);
  const double expected =
      1.0 / (std::pow(c, 4) / E1 + (1.0 / G - 2.0 * nu / E1) * s * s * c * c + std::pow(s, 4) / E2);
  // The fibers are along axis 1, the radial one; a rotation about axis 3 turns them toward axis 2.
  const Matrix6 compliance = stiffness_of(engineering(E1, E2, nu, G), 3, angle).inverse();
  EXPECT_NEAR(1.0 / compliance(0, 0), expected, 1e-9 * expected);
  // Radial stress shears the lamina in the plane of the rotation: fibers lean toward +2 and tension
  // turns them back, gamma_12 < 0.
  EXPECT_LT(compliance(3, 0), 0.0);
  EXPECT_NEAR(compliance(4, 0), 0.0, 1e-20);
  EXPECT_NEAR(compliance(5, 0), 0.0, 1e-20);
}

TEST(InpMaterials, WhatIsNoMaterialIsRefused) {
  const auto complaint = [](const std::string& law) {
    try {
      stiffness_of(law);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(complaint("*ELASTIC\n-1,0.3"), "expected E > 0");
  says(complaint("*ELASTIC\n1,0.5"), "nu < 0.5");
  says(complaint(engineering(1.0, 1.0, 0.8, 1.0)), "not positive definite");
  says(complaint(engineering(1.0, 0.0, 0.3, 1.0)), "a modulus of 0");
  says(complaint("*ELASTIC,TYPE=SHEAR\n1"), "expected ISO, ENGINEERING CONSTANTS, ORTHO or ANISO");
  says(complaint("*ELASTIC\n1,0.3,20,4"), "expected 2 at one temperature");
  says(complaint("*HYPERELASTIC,NEO HOOKE\n1,0"), "D1 is 0");
  says(complaint("*ELASTIC\n1,0.3\n*NO COMPRESSION"), "expected it of rebars only");
}

}  // namespace
}  // namespace latsch::formats
