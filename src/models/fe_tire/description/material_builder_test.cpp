// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

// Reference values are the rows *ELASTIC, TYPE=ANISO of the first and the middle column in the
// CalculiX deck of tire B (N/mm^2; CalculiX orders the shear terms 12, 13, 23).
TEST(MaterialBuilder, SmearedLayerOfTireBIsThatOfTheCalculixDeck) {
  const Materials materials = build_materials(reference_tire_b());
  const int regions = static_cast<int>(reference_tire_b().regions.size());
  const Matrix6 bead = std::get<StVenantKirchhoff>(materials.solids[regions].law).D / 1e6;
  EXPECT_NEAR(bead(0, 0), 166.571413, 1e-4);
  EXPECT_NEAR(bead(2, 2), 198.878464, 1e-4);
  EXPECT_NEAR(bead(0, 5), -70.7875562, 1e-4);
  EXPECT_NEAR(bead(2, 5), -86.8569401, 1e-4);
  EXPECT_NEAR(bead(5, 5), 80.4116734, 1e-4);
  const Solid& crown = materials.solids[regions + 14];
  const Matrix6 D = std::get<StVenantKirchhoff>(crown.law).D / 1e6;
  EXPECT_NEAR(D(1, 1), 5079.3283, 1e-3);
  EXPECT_NEAR(D(1, 2), 1019.10705, 1e-3);
  EXPECT_NEAR(D(2, 2), 618.457593, 1e-3);
  EXPECT_NEAR(D(4, 4), 922.440386, 1e-3);
  EXPECT_DOUBLE_EQ(crown.density, 1600.0);
}

}  // namespace
}  // namespace latsch::fe_tire
