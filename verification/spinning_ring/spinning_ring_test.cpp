// SPDX-License-Identifier: Apache-2.0
// Compares spinning rings with CalculiX 2.20, an independent program and closed forms.
#include <gtest/gtest.h>

#include <string>

#include "models/fe_tire/motion/spinning_tire.h"
#include "ring_mesh.h"
#include "spinning_rings.h"

namespace latsch::verification {
namespace {

using namespace latsch::fe_tire;

class GyroRing : public testing::Test {
 protected:
  FeTire tire = gyro_ring();
  Inflated at_rest = *tire.inflate(0.0);
};

TEST(GyroRingList, is_met_by_growth_modes_and_standing_wave) {
  const GyroRingErrors errors = gyro_ring_errors();
  EXPECT_LT(errors.calculix, 1e-3);
  EXPECT_LT(errors.independent, 2e-4);
  EXPECT_LT(errors.hub, 2e-4);
  EXPECT_LT(errors.by_flow, 1e-4);
  EXPECT_LT(errors.growth, 1e-4);
  EXPECT_LT(errors.standing_wave, 2e-3);
}

TEST_F(GyroRing, gives_the_lowest_modes_seen_from_the_axle_and_no_other) {
  SpinningTire spinning(tire);
  const Inflated state = *spinning.inflate(at_rest, kGyroSpeed);
  const auto few = spinning.modes(state, {}, 12), many = spinning.modes(state, {}, 60);
  ASSERT_EQ(few->size(), 12u);
  for (std::size_t k = 0; k < few->size(); ++k) {
    EXPECT_NEAR((*few)[k].frequency, (*many)[k].frequency, 1e-7 * (*many)[k].frequency);
    EXPECT_EQ((*few)[k].label(), (*many)[k].label());
  }
  EXPECT_EQ((*few)[0].label(), "lateral n=2 against");
  EXPECT_NEAR((*few)[0].frequency, 7.0783, 1e-3);
}

TEST_F(GyroRing, waves_stand_still_at_the_listed_speed) {
  const auto wave = SpinningTire(tire).standing_wave(at_rest);
  ASSERT_TRUE(wave) << wave.failure().reason;
  EXPECT_NEAR(wave->speed, 170.4, 2e-3 * 170.4);
  EXPECT_EQ(wave->n, 3);
  FeTire fine(
      gyro_ring_mesh(72), gyro_ring_materials(), {.element = ElementKind::full_integration});
  const auto finer = SpinningTire(fine).standing_wave(*fine.inflate(0.0));
  ASSERT_TRUE(finer) << finer.failure().reason;
  EXPECT_NEAR(finer->speed, 164.0, 2e-3 * 164.0);
}

TEST_F(GyroRing, above_the_standing_wave_nothing_is_given_but_words) {
  SpinningTire spinning(tire);
  EXPECT_TRUE(spinning.inflate(at_rest, 170.0));
  const auto above = spinning.inflate(at_rest, 171.0);
  ASSERT_FALSE(above);
  EXPECT_NE(above.failure().reason.find("171 rad/s"), std::string::npos) << above.failure().reason;
  EXPECT_NE(above.failure().reason.find("170.3"), std::string::npos) << above.failure().reason;
  EXPECT_NE(above.failure().reason.find("km/h"), std::string::npos) << above.failure().reason;
  EXPECT_NE(above.failure().reason.find("n = 3"), std::string::npos) << above.failure().reason;
}

TEST_F(GyroRing, backward_spin_is_the_mirror_image) {
  SpinningTire spinning(tire);
  const auto forward = spinning.modes(*spinning.inflate(at_rest, 60.0), {}, 12);
  const auto backward = spinning.modes(*spinning.inflate(at_rest, -60.0), {}, 12);
  ASSERT_TRUE(forward && backward);
  for (std::size_t k = 0; k < forward->size(); ++k) {
    EXPECT_NEAR((*forward)[k].frequency, (*backward)[k].frequency, 1e-8 * (*forward)[k].frequency);
    EXPECT_EQ((*forward)[k].label(), (*backward)[k].label());
  }
}

TEST(FreeRing, waves_with_and_against_the_spin_split_as_bryan_says) {
  const SplitErrors errors = bryan_errors(120);
  EXPECT_LT(errors.split, 5e-4);
  EXPECT_LT(errors.product, 5e-4);
}

TEST(FreeRing, inertia_of_the_standing_mesh_splits_them_to_second_order) {
  const SplitErrors coarse = bryan_errors_by_flow(60), fine = bryan_errors_by_flow(120);
  EXPECT_LT(fine.split, 5e-3);
  EXPECT_LT(fine.product, 5e-3);
  EXPECT_GT(coarse.split, 2.5 * fine.split);
}

// With 240 sectors damping is within 1 % (./bench.sh response).
TEST(FreeRing, waves_of_a_ring_that_relaxes_decay_as_its_modulus_says_to_second_order) {
  const DampedRingErrors coarse = damped_ring_errors(60), fine = damped_ring_errors(120);
  EXPECT_LT(fine.frequency, 1e-3);
  EXPECT_LT(fine.damping, 2e-2);
  EXPECT_GT(coarse.damping, 2.5 * fine.damping);
}

// The radius of a free thin ring grows by rho Omega^2 r^3 / E.
TEST(FreeRing, grows_by_the_tension_that_holds_its_mass) {
  FeTire ring(free_ring_mesh(120), free_ring_materials(0.0));
  const auto grown = SpinningTire(ring).inflate(*ring.inflate(0.0), 100.0);
  ASSERT_TRUE(grown) << grown.failure().reason;
  const double expected = kFreeRingDensity * 100.0 * 100.0 * 0.027 / kFreeRingModulus;
  EXPECT_NEAR(grown->growth, expected, 2e-3 * expected);
}

}  // namespace
}  // namespace latsch::verification
