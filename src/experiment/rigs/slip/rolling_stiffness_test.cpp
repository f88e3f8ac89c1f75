// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/rolling_stiffness.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/scratch_folder_testing.h"
#include "experiment/kinds/sparse_tir_testing.h"
#include "experiment/language.h"
#include "experiment/language/capabilities.h"
#include "models/ring_tire/description/ring_reader.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/drum_road.h"
#include "models/road/plane_road.h"

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

// The slopes are equal to those of the coefficients for any relaxation length: the ratio K/c is 0.7
// to 4 m in this test.
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

/// Returns a flexible ring that is shipped with Latsch.
ring_tire::RingTire shipped_ring() {
  const auto file =
      std::filesystem::path(LATSCH_SOURCE_DIR) / "studies/ring_tires/passenger_205_55R16.toml";
  return ring_tire::RingTire(ring_tire::read_ring_tire(Document::read(file).root()));
}

// The tips of the tread blocks move down along the path that they travel within a step. When the
// velocity at the end of the step was used instead, the camber stiffness was -1095 N/rad with steps
// of 0.25 ms and -1564 N/rad with steps of 1 ms.
TEST(RollingStiffness, OfAFlexibleRingDoesNotDependOnTheStep) {
  ring_tire::RingTire tire = shipped_ring();
  const RollingStiffnessTest fine{.speed = 10.0, .load = 4000.0, .step = 2.5e-4},
      coarse{.speed = 10.0, .load = 4000.0, .step = 1e-3};
  const auto leaning = camber_stiffness(tire, fine),
             leaning_coarse = camber_stiffness(tire, coarse);
  ASSERT_TRUE(leaning && leaning_coarse);
  EXPECT_NEAR(*leaning_coarse, *leaning, 0.04 * std::abs(*leaning));
  const auto slip = slip_stiffness(tire, fine), slip_coarse = slip_stiffness(tire, coarse);
  ASSERT_TRUE(slip && slip_coarse);
  EXPECT_NEAR(*slip_coarse, *slip, 2e-3 * *slip);
}

/// Returns the mean side force, N, of a cambered flexible ring on a road that is not level.
double camber_force(const road::Road& road, double step) {
  constexpr double kSpeed = 10.0, kLean = 0.0174532925199, kTime = 0.25, kMean = 0.05;  // .., s
  ring_tire::RingTire tire = shipped_ring();
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - 0.022;
  motion.carrier = Eigen::AngleAxisd(kLean, Eigen::Vector3d::UnitX()).toRotationMatrix();
  motion.spin_rate = kSpeed / (tire.free_radius() - 0.008);
  EXPECT_TRUE(tire.settle(motion, road, 0.0));
  const long steps = std::lround(kTime / step), last = std::lround(kMean / step);
  double sum = 0.0;
  for (long i = 1; i <= steps; ++i) {
    motion.spin += step * motion.spin_rate;
    const auto hub = tire.advance(motion, road, static_cast<double>(i) * step, step);
    EXPECT_TRUE(hub) << hub.failure().reason;
    if (i > steps - last) sum += (motion.carrier * hub->force).y();
  }
  return sum / static_cast<double>(last);
}

TEST(RollingStiffness, CamberForceOnADrumAndOnASlopeDoesNotDependOnTheStep) {
  const road::DrumRoad drum({.diameter = 2.0, .surface = 10.0});
  const road::PlaneRoad slope({.grade = 0.01, .belt = 10.0});
  for (const road::Road* road :
       {static_cast<const road::Road*>(&drum), static_cast<const road::Road*>(&slope)}) {
    const double fine = camber_force(*road, 2.5e-4), coarse = camber_force(*road, 1e-3);
    // The camber force is 8 N at 1 deg (460 N/rad), so an error of 1 N is an eighth of it.
    EXPECT_NEAR(coarse, fine, 1.0);
  }
}

}  // namespace
}  // namespace latsch::experiment
