// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/rolling_stiffness.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"

namespace latsch::experiment {
namespace {

std::unique_ptr<Tire> tire_of(const std::string& tir) {
  const ScratchFolder folder;
  std::ofstream(folder.path() / "tire.tir") << tir;
  const SpecimenKind& kind = *language().find_kind("magic_formula");
  return kind.build(kind.read(folder.path() / "tire.tir"))->find<Rolls>()->tire();
}

// K_xκ = Fz PKX1, K_yα = PKY1 Fz0 sin(2 atan(Fz/(PKY2 Fz0))), K_yγ0 = Fz PKY6, t0 = R0 QDZ1 at the
// nominal load [Pacejka 2012, 4.E15, 4.E25, 4.E30, 4.E42].
TEST(RollingStiffness, OfAMagicFormulaIsThatOfItsCoefficients) {
  const auto tire =
      tire_of(sparse_tir(std::string(kLongitudinalForce) + kSideForce +
                         "PKY6 = -0.8\n"
                         "[ALIGNING_COEFFICIENTS]\nQBZ1 = 8\nQCZ1 = 1.1\nQDZ1 = 0.1\n"));
  const RollingStiffnessTest test{.load = 4000.0, .slip = 1e-4, .angle = 3e-4, .camber = 1e-3};
  const auto slip = slip_stiffness(*tire, test);
  ASSERT_TRUE(slip) << slip.failure().reason;
  EXPECT_NEAR(*slip, 22.0 * 4000.0, 1e-4 * 88e3);
  const auto steered = cornering(*tire, test);
  ASSERT_TRUE(steered) << steered.failure().reason;
  const double K = 18.0 * 4000.0 * std::sin(2.0 * std::atan(1.0 / 1.8));
  EXPECT_NEAR(steered->stiffness, K, 1e-4 * K);
  EXPECT_NEAR(steered->trail, 0.316 * 0.1, 1e-4 * 0.0316);
  const auto leaning = camber_stiffness(*tire, test);
  ASSERT_TRUE(leaning) << leaning.failure().reason;
  EXPECT_NEAR(*leaning, 0.8 * 4000.0, 1e-4 * 3200.0);
}

// The slopes are those of the coefficients however long the relaxation lengths are: K/c is 0.7 to
// 4 m here.
TEST(RollingStiffness, DoesNotDependOnTheRelaxationLength) {
  for (const double stiffness : {1e5, 4e4, 2.2e4}) {
    const auto tire = tire_of(sparse_tir(std::string(kLongitudinalForce) + kSideForce +
                                         fmt::format("[STRUCTURAL]\nLONGITUDINAL_STIFFNESS = {0}\n"
                                                     "LATERAL_STIFFNESS = {0}\n",
                                                     stiffness)));
    const RollingStiffnessTest test{.load = 4000.0, .slip = 1e-4, .angle = 3e-4};
    const auto slip = slip_stiffness(*tire, test);
    ASSERT_TRUE(slip) << slip.failure().reason;
    EXPECT_NEAR(*slip, 22.0 * 4000.0, 1e-3 * 88e3) << stiffness;
    const auto steered = cornering(*tire, test);
    ASSERT_TRUE(steered) << steered.failure().reason;
    const double K = 18.0 * 4000.0 * std::sin(2.0 * std::atan(1.0 / 1.8));
    EXPECT_NEAR(steered->stiffness, K, 1e-3 * K) << stiffness;
  }
}

// A stiff carcass on a tread that sticks is the brush model [Pacejka 2012, 3.2.1]: the slope is the
// same along and across, and the trail is a third of half the patch's length, the length of its
// longest line.
TEST(RollingStiffness, OfAStiffRingIsThatOfABrush) {
  auto ring =
      ring_tire::read_ring_tire(Document::read(std::filesystem::path(LATSCH_SOURCE_DIR) /
                                               "studies/ring_tires/passenger_205_55R16.toml")
                                    .root());
  ring.sidewall.tangential.stiffness = ring.sidewall.lateral.stiffness = 5e6;
  ring.sidewall.torsion = 1e5;
  ring.belt.bending_out_of_plane = 1e4;
  ring.tread.shear_ratio = 0.01;
  ring.tread.damping_time = 0.0;  // dampers would release the road before the patch ends
  ring_tire::RingTire tire(ring);
  const RollingStiffnessTest test{.load = 4000.0, .step = 1e-4};
  const auto slip = slip_stiffness(tire, test);
  const auto steered = cornering(tire, test);
  ASSERT_TRUE(slip) << slip.failure().reason;
  ASSERT_TRUE(steered) << steered.failure().reason;
  EXPECT_NEAR(steered->stiffness, *slip, 1e-3 * *slip);
  const auto patch = tire.footprint();
  ASSERT_TRUE(patch);
  const double a = 0.5 * patch->length;
  EXPECT_NEAR(steered->trail, a / 3.0, 0.015 * a);
}

}  // namespace
}  // namespace latsch::experiment
