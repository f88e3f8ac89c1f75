// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/footprint_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/rigs/fe_tire/tire_footprint.h"
#include "models/fe_tire/analysis/fe_tire.h"
#include "models/fe_tire/analysis/ring_assembly.h"
#include "models/fe_tire/description/reference_tires.h"

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::Ground;

constexpr double kFootprintPressure = 2.6e5;

/// Tire B on a mesh of a few hundred elements: coarse, but with all its physics.
fe_tire::TireDescription coarse_tire_b() {
  auto tire = fe_tire::reference_tire_b();
  tire.section.meridional = 14;
  tire.section.sectors = 24;
  return tire;
}

FeTire build(const fe_tire::TireDescription& tire) {
  return {fe_tire::build_mesh(tire), fe_tire::build_materials(tire)};
}

FootprintTest at_deflections(std::vector<double> deflections) {
  FootprintTest test;
  test.deflections = std::move(deflections);
  return test;
}

std::vector<StandingFootprint> standing(const fe_tire::TireDescription& description,
                                        const FootprintTest& test,
                                        const Ground& ground = {}) {
  FeTire tire = build(description);
  const auto states = stand_in_states(tire, kFootprintPressure, ground, test);
  EXPECT_TRUE(states) << states.failure().reason;
  return footprints(tire, *states);
}

/// Returns the total force of the elements, N.
double carried(const Footprint& print) {
  double sum = 0.0;
  for (const FootprintElement& at : print.elements) sum += at.pressure * at.length * at.width;
  return sum;
}

/// In equilibrium the ground's force balances that of rubber, cords and pressure, which is computed
/// here: their work, J, if every free node rises by one meter. That sum does not involve the
/// contact.
double unbalanced(const fe_tire::TireDescription& description, double deflection) {
  FeTire tire = build(description);
  const auto inflated = tire.inflate(kFootprintPressure);
  EXPECT_TRUE(inflated) << inflated.failure().reason;
  const auto loaded = tire.press(*inflated, Ground{}, {deflection});
  EXPECT_TRUE(loaded) << loaded.failure().reason;

  const fe_tire::Ring ring(fe_tire::build_mesh(description), description.element);
  const fe_tire::RingUnknowns whole(ring, fe_tire::RingSymmetry::none, {});
  const fe_tire::RingAssembly assembly(whole);
  fe_tire::AssembledState state = assembly.zero_state();
  state.x = whole.compress(loaded->back().u);
  Eigen::VectorXd unbalanced;
  const fe_tire::RingElements elements(ring, tire.materials());
  EXPECT_TRUE(assembly.assemble(elements, state, kFootprintPressure, unbalanced, nullptr, nullptr));
  Eigen::Matrix3Xd rise(3, ring.mesh().nodes());
  const int n = ring.mesh().nodes_per_sector();
  for (int s = 0; s < ring.sectors(); ++s)
    rise.middleCols(s * n, n).colwise() =
        ring.mesh().frame(s).transpose() * Eigen::Vector3d::UnitZ();
  return unbalanced.dot(whole.compress(rise));
}

TEST(FeFootprint, CarriesWhatTheTireLeavesUnbalanced) {
  const auto description = coarse_tire_b();
  const double work = unbalanced(description, 0.012);
  const Footprint print = standing(description, at_deflections({0.012}))[0].footprint;
  EXPECT_NEAR(print.load, work, 1e-3 * work);
  EXPECT_NEAR(carried(print), work, 1e-3 * work);
}

// For a given load the rig returns a deflection; at that deflection the tire leaves exactly that
// load unbalanced, whatever path the rig took to it.
TEST(FeFootprint, UnderALoadStandsAsDeepAsCarriesIt) {
  const auto description = coarse_tire_b();
  FootprintTest test;
  test.loads = {3000.0};
  const StandingFootprint state = standing(description, test)[0];
  EXPECT_NEAR(unbalanced(description, state.deflection), 3000.0, 1e-3 * 3000.0);
  EXPECT_NEAR(carried(state.footprint), 3000.0, 1e-3 * 3000.0);
}

// A ground much softer than the tire shows the inflated contour itself, at the crown a circle of
// radius R: depth d(x) = δ - R + sqrt(R² - x²), pressure ε d over the area of the tread, of which
// the ground sees cos θ, sin θ = x/R; chord 2 sqrt(δ (2R - δ)). Sectors of 3° are chords up to 0.11
// mm inside the arc; the tread falls by 0.1 mm within 10 mm of the crown; inflation stretches it by
// less than 1 % of d. The outline ends at the last of eight samples of a sector, 2 mm apart.
TEST(FeFootprint, OnNextToNoGroundIsTheContourItself) {
  auto description = coarse_tire_b();
  description.section.sectors = 120;
  const double delta = 0.010, stiffness = 1e3;
  const Footprint print =
      standing(description, at_deflections({delta}), Ground{stiffness, 0.0})[0].footprint;
  FeTire tire = build(description);
  const auto inflated = tire.inflate(kFootprintPressure);
  ASSERT_TRUE(inflated) << inflated.failure().reason;
  const double R = inflated->radius;
  int at_crown = 0;
  for (const FootprintElement& at : print.elements) {
    if (std::abs(at.y) > 0.010) continue;
    ++at_crown;
    const double height = std::sqrt(R * R - at.x * at.x);
    const double depth = delta - R + height;
    EXPECT_NEAR(at.pressure, stiffness * depth * R / height, stiffness * 0.31e-3) << at.x;
  }
  EXPECT_GE(at_crown, 8);  // a node every 16 mm
  const double chord = 2.0 * std::sqrt(delta * (2.0 * R - delta));
  EXPECT_LT(print.length, chord);
  EXPECT_GT(print.length, chord - 2.0 * 2.0e-3);
}

// Faces in contact lie flat, so the outline advances by sectors (here 16 mm) and may vary between
// them by a sample of a face, 2 mm; the area does not.
TEST(FeFootprint, PushesOnlyAndGrowsWithTheDeflection) {
  auto description = coarse_tire_b();
  description.section.sector_zones = {{10, 3.0 * std::numbers::pi / 180.0}};
  const auto states = standing(description, at_deflections({0.005, 0.010, 0.015, 0.020}));
  ASSERT_EQ(states.size(), 4u);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Footprint& print = states[i].footprint;
    for (const FootprintElement& at : print.elements) EXPECT_GE(at.pressure, 0.0);
    if (i == 0) continue;
    const Footprint& before = states[i - 1].footprint;
    EXPECT_GT(print.length, before.length - 0.002) << states[i].deflection;
    EXPECT_GT(print.area, before.area) << states[i].deflection;
    EXPECT_GT(print.load, before.load) << states[i].deflection;
  }
  EXPECT_GT(states[3].footprint.length, states[0].footprint.length + 0.032);
}

}  // namespace
}  // namespace latsch::experiment
