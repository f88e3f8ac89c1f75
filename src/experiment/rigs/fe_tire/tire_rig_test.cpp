// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/tire_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiment/rigs/fe_tire/deflection_for_load.h"
#include "experiment/rigs/mode_record.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::Ground;

constexpr double kPressure = 2.6e5;

/// Tire B on a mesh of a few hundred elements: coarse, but with all its physics.
FeTire coarse_tire() {
  auto tire = fe_tire::reference_tire_b();
  tire.section.meridional = 14;
  tire.section.sectors = 24;
  return {fe_tire::build_mesh(tire), fe_tire::build_materials(tire)};
}

LoadDeflection curve(std::vector<double> deflections) {
  return {kPressure, Ground{}, std::move(deflections), {}};
}

template <class T>
Result<Channels> run(FeTire& tire, const T& test) {
  return TireRig(tire, kPressure).run(test);
}

ModalTest modal(int count) {
  ModalTest test;
  test.pressure = kPressure;
  test.count = count;
  return test;
}

TEST(TireRig, LoadedRadiusAndDeflectionAreTheSameCurve) {
  FeTire tire = coarse_tire();
  const auto by_deflection = run(tire, curve({0.005, 0.010}));
  ASSERT_TRUE(by_deflection) << by_deflection.failure().reason;
  const LoadDeflection by_radius{kPressure, Ground{}, {}, (*by_deflection)["loaded_radius"]};
  const auto again = run(tire, by_radius);
  ASSERT_TRUE(again);
  for (size_t i = 0; i < 2; ++i) {
    const double force = (*by_deflection)["force"][i];
    EXPECT_GT(force, 100.0);
    EXPECT_NEAR((*again)["force"][i], force, 1e-6 * force);  // one rounding of the deflection
  }
}

TEST(TireRig, GivesPointsInTheOrderAskedFor) {
  FeTire tire = coarse_tire();
  const auto results = run(tire, curve({0.010, 0.005}));
  ASSERT_TRUE(results);
  const auto& force = (*results)["force"];
  EXPECT_EQ((*results)["deflection"], (std::vector<double>{0.010, 0.005}));
  EXPECT_GT(force[0], force[1]);
}

TEST(TireRig, ARadiusBeyondTheTireCarriesNothing) {
  FeTire tire = coarse_tire();
  const auto results = run(tire, LoadDeflection{kPressure, Ground{}, {}, {1.0}});
  ASSERT_TRUE(results);
  EXPECT_EQ((*results)["force"][0], 0.0);
  EXPECT_EQ((*results)["patch_area"][0], 0.0);
}

// A recording is a function of the tire and the test, to the last bit, whatever else is recorded
// before it and beside it. The modal test has exactly the path of the second curve, which is
// therefore reused.
TEST(TireRig, ARecordingDoesNotDependOnOtherTests) {
  FeTire tire = coarse_tire();
  ModalTest standing = modal(6);
  standing.deflection = 0.010;
  const LoadDeflection deep = curve({0.005, 0.012}),
                       even = curve({0.002, 0.004, 0.006, 0.008, 0.010});
  const auto alone = run(tire, standing);
  const auto deep_alone = run(tire, deep);
  ASSERT_TRUE(alone && deep_alone);
  TireRig rig(tire, kPressure);
  const auto first = rig.run(deep), between = rig.run(even);
  const auto last = rig.run(standing);
  ASSERT_TRUE(first && between && last);
  EXPECT_EQ(*first, *deep_alone);
  EXPECT_EQ(*last, *alone);
  EXPECT_EQ(*rig.run(deep), *deep_alone);
}

// Without friction the equilibrium does not depend on the path: only the rounding of the Newton
// iterations does, 1e-6 of the residual, a hundredfold of that in the result.
TEST(TireRig, WithoutFrictionTheWayDoesNotMatter) {
  FeTire tire = coarse_tire();
  const auto short_way = run(tire, curve({0.010})),
             long_way = run(tire, curve({0.003, 0.007, 0.010}));
  ASSERT_TRUE(short_way && long_way);
  const double force = (*short_way)["force"][0];
  EXPECT_NEAR((*long_way)["force"][2], force, 1e-4 * force);
}

// Resuming after an interruption, and using any number of workers, require that a trial does not
// depend on earlier trials.
TEST(TireRig, ATrialDoesNotDependOnTheTrialsBeforeIt) {
  auto soft_description = fe_tire::reference_tire_b();
  soft_description.section.meridional = 14;
  soft_description.section.sectors = 24;
  for (auto& ply : soft_description.plies) ply.cords.E_tension *= 0.5;
  FeTire tire = coarse_tire();
  const fe_tire::Materials stiff = tire.materials();
  ModalTest standing = modal(6);
  standing.deflection = 0.010;
  const auto record = [&] {
    TireRig rig(tire, kPressure);
    return std::vector{rig.run(curve({0.005, 0.010})), rig.run(standing), rig.run(modal(6))};
  };
  const auto first = record();
  tire.set(fe_tire::build_materials(soft_description));
  const auto other = record();
  tire.set(stiff);
  const auto again = record();
  for (size_t i = 0; i < first.size(); ++i) {
    ASSERT_TRUE(first[i] && other[i] && again[i]);
    EXPECT_EQ(*first[i], *again[i]) << i;  // compared bit by bit
    EXPECT_FALSE(*first[i] == *other[i]) << i;
  }
}

TEST(TireRig, PressesUntilTheTireCarriesTheLoad) {
  FeTire tire = coarse_tire();
  ModalTest standing = modal(4);
  standing.load = 3000.0;
  const auto results = run(tire, standing);
  ASSERT_TRUE(results) << results.failure().reason;
  // The loading reports that it ends at 3000 N; a curve to the same deflection in other steps
  // checks it. Without friction the path does not matter; the solver's tolerance does.
  const double deflection = (*results)["deflection"][0];
  const auto pressed = run(tire, curve({0.3 * deflection, deflection}));
  ASSERT_TRUE(pressed);
  EXPECT_NEAR((*pressed)["force"][1], 3000.0, 3000.0 * 1e-4);
  EXPECT_LT((*pressed)["force"][0], 1500.0);
}

TEST(TireRig, RecordsShapesAtTheSensorsInTheWheelFrame) {
  FeTire tire = coarse_tire();
  ModalTest test = modal(6);
  test.points = default_points(tire.mesh());
  const auto results = run(tire, test);
  ASSERT_TRUE(results);
  const auto modes = mode_records(*results);
  ASSERT_EQ(modes.size(), 6u);
  EXPECT_EQ(modes[0].shape.size(), test.points.size());
  for (const ModeRecord& mode : modes) EXPECT_GT(mode.shape.norm(), 0.0);
}

TEST(TireRig, WhatIsDeeperThanTheRimFails) {
  FeTire tire = coarse_tire();
  EXPECT_FALSE(run(tire, curve({0.5})));
}

TEST(PointsOnTire, AreWithinSomeMillimetersOfTheWallAndNotInAnotherUnitOrOrder) {
  FeTire tire = coarse_tire();
  const Eigen::Matrix3Xd points = default_points(tire.mesh());
  EXPECT_TRUE(points_on_tire(tire.mesh(), points).ok());
  const auto moved = [&](double outward) {
    Eigen::Matrix3Xd all = points;
    const double r = std::hypot(all(0, 0), all(2, 0));
    all(0, 0) *= 1.0 + outward / r;
    all(2, 0) *= 1.0 + outward / r;
    return all;
  };
  EXPECT_TRUE(points_on_tire(tire.mesh(), moved(0.010)).ok());
  EXPECT_FALSE(points_on_tire(tire.mesh(), moved(0.090)).ok());
  // Points in meters instead of millimeters, points with exchanged columns and a point at the
  // center of the axle are refused.
  EXPECT_FALSE(points_on_tire(tire.mesh(), 1e3 * points).ok());
  EXPECT_FALSE(points_on_tire(tire.mesh(), points({1, 0, 2}, Eigen::all)).ok());
  EXPECT_FALSE(points_on_tire(tire.mesh(), Eigen::Vector3d::Zero()).ok());
  ModalTest test = modal(2);
  test.points = Eigen::Vector3d(0.0, 0.0, 31.0);
  EXPECT_FALSE(run(tire, test));
}

// A point on the sidewall is assigned a node of the sidewall, not one of the tread.
TEST(NearestSensors, TakesAnyNodeOfTheOuterSurface) {
  const FeTire tire = coarse_tire();
  for (const fe_tire::Element& element : tire.mesh().elements) {
    if (!element.tread) continue;
    const Eigen::Vector3d corner = tire.mesh().coordinates(element).col(7);
    EXPECT_NEAR(nearest_sensors(tire.mesh(), corner).largest_distance, 0.0, 1e-12);
  }
}

TEST(NearestSensors, FindsThePointItself) {
  const FeTire tire = coarse_tire();
  const auto nearest = nearest_sensors(tire.mesh(), default_points(tire.mesh()));
  EXPECT_NEAR(nearest.largest_distance, 0.0, 1e-12);
}

}  // namespace
}  // namespace latsch::experiment
