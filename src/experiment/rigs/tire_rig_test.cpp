// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/tire_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiment/rigs/deflection_for_load.h"
#include "experiment/rigs/mode_record.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::Ground;

constexpr double kPressure = 2.6e5;

/// Tire B on a mesh of a few hundred elements: coarse, but all its physics.
FeTire coarse_tire() {
  auto tire = fe_tire::reference_tire_b();
  tire.section.meridional = 14;
  tire.section.sectors = 24;
  return {fe_tire::build_mesh(tire), fe_tire::build_materials(tire)};
}

LoadCase curve(std::vector<double> deflections) {
  return {"stiffness", LoadDeflection{kPressure, Ground{}, std::move(deflections), {}}};
}

ModalTest modal(int count) {
  ModalTest test;
  test.pressure = kPressure;
  test.count = count;
  return test;
}

TEST(TireRig, LoadedRadiusAndDeflectionAreTheSameCurve) {
  FeTire tire = coarse_tire();
  const auto by_deflection = run(tire, {curve({0.005, 0.010})});
  ASSERT_TRUE(by_deflection[0].ok()) << by_deflection[0].failure().reason;
  LoadDeflection by_radius{kPressure, Ground{}, {}, (*by_deflection[0])["loaded_radius"]};
  const auto again = run(tire, {{"radii", by_radius}});
  ASSERT_TRUE(again[0].ok());
  for (size_t i = 0; i < 2; ++i) {
    const double force = (*by_deflection[0])["force"][i];
    EXPECT_GT(force, 100.0);
    EXPECT_NEAR((*again[0])["force"][i], force, 1e-6 * force);  // one rounding of the deflection
  }
}

TEST(TireRig, GivesPointsInTheOrderAskedFor) {
  FeTire tire = coarse_tire();
  const auto results = run(tire, {curve({0.010, 0.005})});
  ASSERT_TRUE(results[0].ok());
  const auto& force = (*results[0])["force"];
  EXPECT_EQ((*results[0])["deflection"], (std::vector<double>{0.010, 0.005}));
  EXPECT_GT(force[0], force[1]);
}

TEST(TireRig, ARadiusBeyondTheTireCarriesNothing) {
  FeTire tire = coarse_tire();
  const auto results = run(tire, {{"far", LoadDeflection{kPressure, Ground{}, {}, {1.0}}}});
  ASSERT_TRUE(results[0].ok());
  EXPECT_EQ((*results[0])["force"][0], 0.0);
  EXPECT_EQ((*results[0])["patch_area"][0], 0.0);
}

// Without friction the equilibrium does not depend on the way to it, so sharing the loading changes
// nothing but the rounding of the Newton iterations: 1e-6 of the residual, a hundredfold of that in
// the result.
TEST(TireRig, SharingTheLoadingDoesNotChangeTheResult) {
  FeTire tire = coarse_tire();
  ModalTest standing = modal(6);
  standing.deflection = 0.010;
  const auto alone = run(tire, {{"modes", standing}});
  const auto shared = run(tire, {curve({0.004, 0.012}), {"modes", standing}});
  ASSERT_TRUE(alone[0].ok() && shared[1].ok());
  for (size_t i = 0; i < 6; ++i) {
    const double f = (*alone[0])["frequency"][i];
    EXPECT_NEAR((*shared[1])["frequency"][i], f, 1e-4 * f);
  }
}

// What resuming after an interruption and any number of workers stand on: a trial leaves nothing
// behind.
TEST(TireRig, ATrialDoesNotDependOnTheTrialsBeforeIt) {
  auto soft_description = fe_tire::reference_tire_b();
  soft_description.section.meridional = 14;
  soft_description.section.sectors = 24;
  for (auto& ply : soft_description.plies) ply.cords.E_tension *= 0.5;
  FeTire tire = coarse_tire();
  const fe_tire::Materials stiff = tire.materials();
  ModalTest standing = modal(6);
  standing.deflection = 0.010;
  const std::vector<LoadCase> cases = {
      curve({0.005, 0.010}), {"modes", standing}, {"free", modal(6)}};

  const auto first = run(tire, cases);
  tire.set(fe_tire::build_materials(soft_description));
  const auto other = run(tire, cases);
  tire.set(stiff);
  const auto again = run(tire, cases);
  for (size_t i = 0; i < cases.size(); ++i) {
    ASSERT_TRUE(first[i].ok() && other[i].ok() && again[i].ok());
    EXPECT_EQ(*first[i], *again[i]) << cases[i].name;  // bit by bit
    EXPECT_FALSE(*first[i] == *other[i]) << cases[i].name;
  }
}

TEST(TireRig, PressesUntilTheTireCarriesTheLoad) {
  FeTire tire = coarse_tire();
  ModalTest standing = modal(4);
  standing.load = 3000.0;
  const auto results = run(tire, {{"modes", standing}});
  ASSERT_TRUE(results[0].ok()) << results[0].failure().reason;
  // The loading ends where it says 3000 N: whether that is so, a curve to the same deflection in
  // other steps tells. Without friction the way does not matter; the solver's tolerance does.
  const double deflection = (*results[0])["deflection"][0];
  const auto pressed = run(tire, {curve({0.3 * deflection, deflection})});
  ASSERT_TRUE(pressed[0].ok());
  EXPECT_NEAR((*pressed[0])["force"][1], 3000.0, 3000.0 * 1e-4);
  EXPECT_LT((*pressed[0])["force"][0], 1500.0);
}

TEST(TireRig, RecordsShapesAtTheSensorsInTheWheelFrame) {
  FeTire tire = coarse_tire();
  ModalTest test = modal(6);
  test.points = default_points(tire.mesh());
  const auto results = run(tire, {{"modes", test}});
  ASSERT_TRUE(results[0].ok());
  const auto modes = mode_records(*results[0]);
  ASSERT_EQ(modes.size(), 6u);
  EXPECT_EQ(modes[0].shape.size(), test.points.size());
  for (const ModeRecord& mode : modes) EXPECT_GT(mode.shape.norm(), 0.0);
}

TEST(TireRig, AFailureNamesItsExperiment) {
  FeTire tire = coarse_tire();
  const auto results = run(tire, {curve({0.5})});  // deeper than the rim
  ASSERT_FALSE(results[0].ok());
  EXPECT_EQ(results[0].failure().reason.find("experiment stiffness: "), 0u)
      << results[0].failure().reason;
}

TEST(NearestSensors, FindsThePointItself) {
  const FeTire tire = coarse_tire();
  const auto nearest = nearest_sensors(tire.mesh(), default_points(tire.mesh()));
  EXPECT_NEAR(nearest.largest_distance, 0.0, 1e-12);
}

}  // namespace
}  // namespace latsch::experiment
