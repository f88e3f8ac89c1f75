// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_rolling/ground_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::experiment {
namespace {

constexpr double kInflation = 2.6e5, kSpeed = 20.0;

/// Tire B with few columns and the friction of its file.
class GroundFriction : public testing::Test {
 protected:
  static fe_tire::TireDescription few_columns() {
    fe_tire::TireDescription tire = fe_tire::reference_tire_b();
    tire.element = fe_tire::ElementKind::solid_shell;
    tire.section.meridional = 13;
    return tire;
  }
  GroundFriction() : tire_(few_columns()), rig_(tire_, kInflation) {}

  static fe_tire::RollingFriction law(double peak_speed) {
    return {.at_rest = 0.9, .p_0 = 2e5, .a = 0.1, .peak = 1.5, .peak_speed = peak_speed};
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  fe_tire::FeTire tire_;
  TireRig rig_;
};

TEST_F(GroundFriction, FallsNoFasterThanTheTreadHolds) {
  const fe_tire::RollingFriction slow = law(2.0), steep = law(0.02);
  EXPECT_EQ(stable_friction(rig_, slow, kInflation, kSpeed).line_to, 0.0);
  const auto limited = stable_friction(rig_, steep, kInflation, kSpeed);
  EXPECT_GT(limited.line_to, limited.line_from);
  // The fall is inversely as the speed: d(mu p)/dw of a modulus of the tread over the speed.
  const auto faster = stable_friction(rig_, steep, kInflation, 2.0 * kSpeed);
  EXPECT_NEAR(faster.line_fall, 0.5 * limited.line_fall, 1e-9 * limited.line_fall);
  const auto softer = stable_friction(rig_, steep, 0.5 * kInflation, kSpeed);
  EXPECT_NEAR(softer.line_fall, std::pow(2.0, 0.9) * limited.line_fall, 1e-9 * softer.line_fall);
}

TEST_F(GroundFriction, IsSaidWithItsLimitAndWhenTheTireStands) {
  EXPECT_TRUE(has(friction_in_words(rig_, kInflation, kSpeed), "friction 1 is taken"));
  EXPECT_EQ(friction_at_rest_in_words(rig_, 0.8), "");
  rig_.set_friction(fe_tire::RollingFriction{.at_rest = 0.9});
  EXPECT_EQ(friction_at_rest_in_words(rig_, 0.8), "");
  rig_.set_friction(law(2.0));
  const std::string words = friction_in_words(rig_, kInflation, kSpeed);
  EXPECT_TRUE(has(words, "0.9 at 2 bar, less by the power 0.1")) << words;
  EXPECT_TRUE(has(words, "1.35 at a sliding speed of 2 m/s")) << words;
  EXPECT_FALSE(has(words, "jerks")) << words;
  rig_.set_friction(law(0.02));
  EXPECT_TRUE(has(friction_in_words(rig_, kInflation, kSpeed), "above the law of the file"));
  EXPECT_TRUE(has(friction_at_rest_in_words(rig_, 0.8), "stands on the friction 0.8 of the test"));
  EXPECT_TRUE(has(friction_at_rest_in_words(rig_, 0.0), "ground without friction"));
}

// Sweeps of the rig come to one state of each slip from either end, on a law at its limit, and a
// locked wheel has the law's force.
TEST_F(GroundFriction, AWheelBrakesOverThePeakToTheForceOfTheLaw) {
  rig_.set_friction(law(0.02));
  RollingTest test{.rows = {}};
  for (const double kappa : {-0.01, -0.02, -0.05, -1.0})
    test.rows.push_back({3000.0, kSpeed, kappa});
  const auto sweep = roll_states(rig_, test);
  ASSERT_TRUE(sweep) << sweep.failure().reason;
  for (std::size_t k = 0; k < 3; ++k) {
    RollingTest one{.rows = {test.rows[3], test.rows[k]}};
    const auto back = roll_states(rig_, one);
    ASSERT_TRUE(back) << back.failure().reason;
    EXPECT_NEAR((*back)[1].state.forces.force.x(), (*sweep)[k].state.forces.force.x(), 0.1) << k;
  }
  double force = 0.0;
  for (const fe_tire::RollingPatchPoint& at : (*sweep)[3].state.patch) {
    const double log = std::log(kSpeed / 0.02);
    force += 0.9 * std::pow(at.pressure / 2e5, -0.1) * (1.0 + 0.5 * std::exp(-log * log)) *
             at.pressure * at.area;
  }
  EXPECT_NEAR(-(*sweep)[3].state.forces.force.x(), force, 1e-6 * force);
}

}  // namespace
}  // namespace latsch::experiment
