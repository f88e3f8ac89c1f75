// SPDX-License-Identifier: Apache-2.0
// Tests that the deflection-load curve of a file is the vertical force in every version of the
// formula, and that the deflection is its inverse.
#include "models/magic_formula/vertical/load_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/magic_formula/magic_formula_slopes.h"
#include "models/magic_formula/magic_formula_tire.h"
#include "models/magic_formula/round_tire_testing.h"
#include "models/road/plane_road.h"

namespace latsch::magic_formula {
namespace {

/// Returns a tire with a curve of 200 N/mm up to 10 mm and 300 N/mm beyond, whose last point is at
/// 5 kN.
Parameters curved_tire(Version version) {
  Parameters p = round_tire();
  p.version = version;
  p.Q_FZ2 = 10.0;  // this coefficient must have no effect, because the curve replaces the formula
  p.PFZ1 = 0.7;
  p.Q_FCX = 0.5;
  p.curve_deflection = {0.0, 0.01, 0.02};
  p.curve_force = {0.0, 2000.0, 5000.0};
  return p;
}

State straight_under(double Fz) { return {Fz, 0.0, 0.0, 0.0, 0.0, 20.0, 2.4e5}; }

TEST(LoadCurve, SteadyStatesHaveItsDeflectionInEveryVersion) {
  for (const Version version : {Version::mf52, Version::mf61, Version::mf62}) {
    const MagicFormula tire(curved_tire(version));
    for (const auto& [Fz, rho] :
         {std::pair{1000.0, 0.005}, {2000.0, 0.01}, {3500.0, 0.015}, {8000.0, 0.03}}) {
      const SteadyState s = tire.evaluate(straight_under(Fz));
      EXPECT_NEAR(s.rho, rho, 1e-15) << Fz;
      EXPECT_NEAR(s.R_l, 0.3 - rho, 1e-12);
      EXPECT_NEAR(s.Cz, Fz / rho, 1e-6);
      EXPECT_NEAR(tire.vertical_force(rho, 60.0, 0.1, 1.5e5, 900.0, 0.0), Fz, 1e-9);
    }
    EXPECT_EQ(tire.evaluate(straight_under(0.0)).rho, 0.0);
    EXPECT_NEAR(tire.evaluate(straight_under(0.0)).Cz, 2e5, 1e-6);
  }
}

TEST(LoadCurve, ARollingTireStandsWhereTheSteadyStateSays) {
  const Parameters p = curved_tire(Version::mf61);
  MagicFormulaTire tire(p);
  WheelMotion motion;
  motion.center.z() = MagicFormula(p).evaluate(straight_under(4000.0)).R_l;
  const auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
  ASSERT_TRUE(hub.ok());
  EXPECT_NEAR(hub->force.z(), 4000.0, 1e-6);
}

TEST(LoadCurve, SlopesAreThoseOfItsLinesWithTheSameValues) {
  for (const Version version : {Version::mf61, Version::mf62}) {
    const MagicFormula tire(curved_tire(version));
    std::vector<State> states;
    for (const double Fz : {1000.0, 3500.0, 8000.0}) states.push_back(straight_under(Fz));
    const std::vector<std::string> by = {"Fz", "Q_FZ2", "UNLOADED_RADIUS"};
    const auto found = steady_state_slopes(
        tire, states, by, std::vector{&SteadyState::rho, &SteadyState::R_l, &SteadyState::Cz});
    const double C[] = {2e5, 3e5, 3e5};
    for (int i = 0; i < 3; ++i) {
      const SteadyState s = tire.evaluate(states[i]);
      EXPECT_EQ(found.values(i, 0), s.rho);
      EXPECT_EQ(found.values(i, 1), s.R_l);
      EXPECT_EQ(found.values(i, 2), s.Cz);
      EXPECT_NEAR(found.slopes[0](i, 0), 1.0 / C[i], 1e-15);
      EXPECT_NEAR(found.slopes[2](i, 0), 1.0 / s.rho - s.Fz / (s.rho * s.rho * C[i]), 1e-6);
      EXPECT_EQ(found.slopes[0](i, 1), 0.0);
      EXPECT_NEAR(found.slopes[1](i, 2), 1.0, 1e-12);
    }
  }
}

TEST(LoadCurve, ASpringInSeriesSharesTheDeflection) {
  const Parameters p = curved_tire(Version::mf61);
  for (const double k : {6e5, 2e6})
    for (const double rho : {0.002, 0.009, 0.012, 0.05}) {
      const double Fz = force_on_curve_with_spring(p, rho, k);
      EXPECT_NEAR(force_on_curve(p, rho + Fz / k), Fz, 1e-9 * Fz) << k << " " << rho;
    }
  EXPECT_EQ(force_on_curve_with_spring(p, -0.001, 6e5), 0.0);
}

}  // namespace
}  // namespace latsch::magic_formula
