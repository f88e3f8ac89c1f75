// SPDX-License-Identifier: Apache-2.0
// Slopes of the channels of a tire's rigs are compared with central differences of whole tests.
#include "experiment/rigs/fe_tire/channel_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "experiment/rigs/fe_tire/standing_rig.h"
#include "experiment/rigs/fe_tire/tire_rig.h"
#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/description/tire_description.h"
#include "models/fe_tire/slopes/tire_slopes.h"

namespace latsch::experiment {
namespace {

using namespace fe_tire;

constexpr double kPressure = 2.6e5, kLoad = 3000.0;

/// Tire B on a coarse mesh, with the modulus of its carcass multiplied by a factor.
TireDescription with_carcass(double factor) {
  TireDescription tire = reference_tire_b();
  tire.cord_model = CordModel::rebar;
  tire.section.meridional = 13;
  tire.section.sectors = 24;
  tire.pressure = kPressure;
  tire.plies[0].cords.E_tension *= factor;
  return tire;
}

VariedTire varied(double factor) {
  const TireDescription tire = with_carcass(factor);
  return {build_mesh(tire), build_materials(tire), tire.pressure};
}

using Run = std::function<Result<Channels>(FeTire& tire, TireSlopes* slopes)>;

/// Compares slopes of these channels relative to themselves or to a hundredth of the value; `share`
/// is the error of differences over `step` of the modulus.
void expect_slopes(const Run& run,
                   const std::vector<std::string>& names,
                   double share,
                   double step = 0.02) {
  constexpr double kVariation = 1e-5;
  FeTire tire(with_carcass(1.0));
  TireSlopes slopes(tire, {{varied(1.0 - kVariation), varied(1.0 + kVariation), kVariation}});
  const auto values_of = [&](double factor) {
    FeTire other(with_carcass(factor));
    auto channels = run(other, nullptr);
    EXPECT_TRUE(channels);
    return *channels;
  };
  const auto found = run(tire, &slopes);
  ASSERT_TRUE(found);
  const Channels below = values_of(1.0 - step), above = values_of(1.0 + step);
  for (const std::string& name : names) {
    const Channel& channel = *found->find(name);
    ASSERT_EQ(channel.slopes.size(), channel.values.size()) << name;
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      const double expected = (above[name][i] - below[name][i]) / (2.0 * step);
      const double size = std::max(std::abs(expected), 1e-2 * std::abs(channel.values[i]));
      EXPECT_NEAR(channel.slopes[i], expected, share * size) << name << ' ' << i;
    }
  }
}

// Loads are reached with a relative accuracy of 1e-5, which differences over steps of 2 % amplify
// to 1e-3. In addition, the stiffness curve has kinks where points come into contact.
TEST(ChannelSlopes, OfTheVerticalStiffness) {
  const auto run = [](FeTire& tire, TireSlopes* slopes) {
    return stand(tire, kPressure, {.load = kLoad, .directions = {Direction::vertical}}, slopes);
  };
  expect_slopes(run, {"vertical"}, 2e-2);
}

TEST(ChannelSlopes, OfForcesOfAStandingTire) {
  const auto run = [](FeTire& tire, TireSlopes* slopes) {
    return stand(tire, kPressure, {.deflections = {0.008, 0.016}}, slopes);
  };
  expect_slopes(run, {"deflection", "force"}, 2e-3);
}

TEST(ChannelSlopes, OfDeflectionUnderALoad) {
  const auto run = [](FeTire& tire, TireSlopes* slopes) {
    ModalTest test;
    test.load = kLoad;
    test.count = 2;
    TireRig rig(tire, kPressure);
    return slopes ? rig.run(test, *slopes, {"deflection", "force"}) : rig.run(test);
  };
  expect_slopes(run, {"frequency", "deflection", "loaded_radius", "force"}, 5e-3);
}

// The patch ends between samples of the tread: its size is piecewise smooth, and only small steps
// stay within a piece.
TEST(ChannelSlopes, OfThePatch) {
  const auto run = [](FeTire& tire, TireSlopes* slopes) {
    LoadDeflection test;
    test.deflections = {0.008, 0.016};
    TireRig rig(tire, kPressure);
    return slopes ? rig.run(test, *slopes, {"patch_area"}) : rig.run(test);
  };
  expect_slopes(run, {"force", "deflection", "loaded_radius"}, 2e-3);
  expect_slopes(run, {"patch_length", "patch_area"}, 2e-2, 5e-4);
}

}  // namespace
}  // namespace latsch::experiment
