// SPDX-License-Identifier: Apache-2.0
// Slopes of the channels of a rolling tire are compared with central differences of whole tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "experiment/rigs/fe_tire/rolling_rig.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {
namespace {

using namespace fe_tire;

/// Numbers of the tire that a test varies, as factors.
struct Factors {
  double carcass = 1.0, rubber = 1.0, density = 1.0, friction = 1.0, pressure = 1.0;
};
double Factors::*const kVaried[] = {
    &Factors::carcass, &Factors::rubber, &Factors::density, &Factors::friction, &Factors::pressure};

/// Tire B with few columns.
TireDescription rolling_tire(const Factors& by) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  tire.pressure = by.pressure * 2.6e5;
  tire.plies[0].cords.E_tension *= by.carcass;
  for (Rubber& rubber : tire.rubbers) rubber.density *= by.density;
  Hyperelastic& outside = tire.rubbers.back().law;
  outside.C10 *= by.rubber;
  outside.C01 *= by.rubber;
  outside.K *= by.rubber;
  tire.friction.emplace();
  tire.friction->at_rest = 0.9 * by.friction;
  return tire;
}

TireRig rig_of(FeTire& tire, const TireDescription& description) {
  TireRig rig(tire, description.pressure);
  rig.set_friction(description.friction);
  return rig;
}

/// A free wheel with a slip angle and a camber, and a wheel with a stated slip, at a high speed.
RollingTest states() {
  RollingTest test;
  test.rows.push_back({.load = 3000.0, .speed = 40.0, .alpha = 0.02, .camber = 0.03});
  test.rows.push_back({.load = 3000.0, .speed = 40.0, .kappa = -0.02, .alpha = -0.01});
  return test;
}

TEST(RollingRates, AreThoseOfDifferences) {
  // Longer steps of the differences pass over points that begin to stick or to slide.
  constexpr double kVariation = 1e-5, kStep = 1e-3, kError = 5e-3;
  std::vector<Variation> variations;
  for (double Factors::*const number : kVaried) {
    const auto varied = [&](double by) {
      Factors factors;
      factors.*number += by;
      const TireDescription tire = rolling_tire(factors);
      return VariedTire{build_mesh(tire), build_materials(tire), tire.pressure, tire.friction};
    };
    variations.push_back(
        {varied(-kVariation), varied(kVariation), kVariation, number == &Factors::pressure});
  }
  const TireDescription description = rolling_tire({});
  FeTire tire(description);
  TireSlopes slopes(tire, std::move(variations));
  TireRig rig = rig_of(tire, description);
  const auto found = roll(rig, states(), &slopes);
  ASSERT_TRUE(found) << found.failure().reason;
  const auto plain = roll(rig, states());
  ASSERT_TRUE(plain);
  for (std::size_t k = 0; k < std::size(kVaried); ++k) {
    const auto values = [&](double by) {
      Factors factors;
      factors.*kVaried[k] += by;
      const TireDescription other = rolling_tire(factors);
      FeTire of_other(other);
      TireRig rig_of_other = rig_of(of_other, other);
      return *roll(rig_of_other, states());
    };
    const Channels below = values(-kStep), above = values(kStep);
    for (const char* name :
         {"Fx", "Fy", "Fz", "Mx", "My", "Mz", "omega", "R_e", "R_l", "drive", "loss_friction"}) {
      const Channel& channel = *found->find(name);
      ASSERT_EQ(channel.slopes.size(), channel.values.size() * std::size(kVaried)) << name;
      for (std::size_t i = 0; i < channel.values.size(); ++i) {
        // Values are the same with and without slopes.
        EXPECT_NEAR(channel.values[i], (*plain)[name][i], 1e-5 * std::abs(channel.values[i]));
        const double expected = (above[name][i] - below[name][i]) / (2.0 * kStep);
        const double slope = channel.slopes[k * channel.values.size() + i];
        const double size = std::max(std::abs(expected), 2e-2 * std::abs(channel.values[i]));
        EXPECT_NEAR(slope, expected, kError * size + 1e-2) << name << ' ' << i << " by " << k;
      }
    }
  }
}

TEST(RollingRates, AreNotToldForTiresThatRelaxNorWithoutFriction) {
  TireDescription description = rolling_tire({});
  FeTire tire(description);
  const VariedTire same{
      build_mesh(description), build_materials(description), description.pressure, {}};
  TireSlopes slopes(tire, {{same, same, 1e-5, false}});
  TireRig rig = rig_of(tire, description);
  EXPECT_NE(known_rates(rig, states(), &slopes), nullptr);
  RollingTest slippery = states();
  slippery.friction = 0.0;
  EXPECT_EQ(known_rates(rig, slippery, &slopes), nullptr);
  for (Rubber& rubber : description.rubbers) rubber.prony = *constant_loss_factor(0.1, 0.1, 1000.0);
  rig.set_losses(build_losses(description));
  EXPECT_EQ(known_rates(rig, states(), &slopes), nullptr);
}

}  // namespace
}  // namespace latsch::experiment
