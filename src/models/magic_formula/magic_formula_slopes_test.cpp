// SPDX-License-Identifier: Apache-2.0
// Tests the derivatives of the Magic Formula against closed forms and finite differences, and at
// kinks, where they are one-sided by convention. The tests with sample tires are in
// verification/magic_formula.
#include "models/magic_formula/magic_formula_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "models/magic_formula/round_tire_testing.h"
#include "models/magic_formula/slope_differences_testing.h"
#include "numerics/kernels/kernel_set.h"

namespace latsch::magic_formula {
namespace {

constexpr Version kVersions[] = {Version::mf52, Version::mf61, Version::mf62};
using S = SteadyState;

double slope(const MagicFormula& tire,
             const State& at,
             Output output,
             const std::string& variable) {
  const std::vector<std::string> variables = {variable};
  return steady_state_slopes(tire, {&at, 1}, variables, {&output, 1}).slopes[0](0, 0);
}

/// Returns a tire all of whose dimensionless coefficients differ from zero, so that each of them
/// has an effect.
Parameters full_tire(Version version) {
  Parameters p = round_tire();
  p.version = version;
  RandomStream random(5, static_cast<std::uint64_t>(version));
  for (const ParameterField& field : parameter_fields())
    if (field.unit == ParameterUnit::one && std::isfinite(p.*field.member) &&
        field.section != "SCALING_COEFFICIENTS")
      p.*field.member += 0.02 + 0.03 * random.uniform();
  p.LMUV = 0.1;
  p.ASPECT_RATIO = 0.5;
  p.FZMIN = 200.0;
  p.FZMAX = 7500.0;
  p.ALPMIN = -0.4;
  p.ALPMAX = 0.4;
  p.KPUMAX = 0.8;
  p.CAMMAX = 0.15;
  p.PRESMIN = 1.7e5;
  return p;
}

std::vector<State> varied_states(int count) {
  std::vector<State> states;
  for (int i = 0; i < count; ++i) {
    RandomStream random(17, i);
    const auto within = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    states.push_back({within(50, 9000),
                      within(-0.9, 0.9),
                      within(-0.5, 0.5),
                      within(-0.2, 0.2),
                      within(-0.2, 0.2),
                      within(-30, 30),
                      within(1.5e5, 3e5)});
    if (i % 7 == 0) states.back().Vx *= 0.03;  // this speed is below VXLOW
    if (i % 5 == 0) states.back().kappa = 0.0;
    if (i % 6 == 0) states.back().gamma = 0.0;
    if (i % 8 == 0) states.back().phit = 0.0;
  }
  return states;
}

class SlopesOfVersion : public testing::TestWithParam<std::tuple<Version, int>> {};

TEST_P(SlopesOfVersion, AreWhatDifferencesTendTo) {
  const auto [version, convention] = GetParam();
  Conventions c;
  c.limits = convention & 1;
  c.angles = convention & 2 ? Angles::tangent : Angles::direct;
  c.turn_slip = convention & 4;
  c.mirrored = convention == 5;
  c.A_mu = convention == 3 ? 10.0 : 1.0;
  const MagicFormula tire(full_tire(version), c);
  const SlopeComparison compared = compare_with_differences(tire, varied_states(60));
  EXPECT_LE(compared.worst, 1.0) << compared.where;
  EXPECT_LE(compared.kinks, 0.01 * compared.count);
  EXPECT_GT(compared.count, 100000);
  EXPECT_EQ(compared.not_the_bits, 0);
}

INSTANTIATE_TEST_SUITE_P(MagicFormula,
                         SlopesOfVersion,
                         testing::Combine(testing::ValuesIn(kVersions), testing::Range(0, 8)));

constexpr State kCornering{4000.0, 0.0, 0.08, 0.0, 0.0, 20.0, 2.2e5};

TEST(MagicFormulaSlopes, WhatStandsAloneInAnEquationIsItsClosedForm) {
  const MagicFormula tire(round_tire());
  const SteadyState s = tire.evaluate(kCornering);
  EXPECT_DOUBLE_EQ(slope(tire, kCornering, &S::Fy, "PVY1"), 4000.0);          // (4.E29)
  EXPECT_DOUBLE_EQ(slope(tire, kCornering, &S::Kya, "PKY1"), s.Kya / -20.0);  // (4.E25)
  EXPECT_DOUBLE_EQ(slope(tire, kCornering, &S::muy, "PDY1"), 1.0);            // (4.E23)
  EXPECT_DOUBLE_EQ(slope(tire, kCornering, &S::Mx, "QSX1"), 0.3 * 4000.0);    // (4.E69)
  EXPECT_DOUBLE_EQ(slope(tire, kCornering, &S::My, "QSY1"), -0.3 * 4000.0);   // (A48)
  EXPECT_DOUBLE_EQ(slope(tire, kCornering, &S::t, "LTR"), s.t);               // (A60)
  EXPECT_DOUBLE_EQ(slope(tire, kCornering, &S::Mz, "SSZ1"), 0.3 * s.Fx);      // (A56)
}

TEST(MagicFormulaSlopes, AtThePeakTheForceGrowsAsFrictionDoes) {
  const MagicFormula tire(round_tire());
  State at = kCornering;
  at.alpha = 0.0;
  // The derivative of the force is zero at its peak, where C atan(Bx - E (Bx - atan Bx)) = pi/2.
  // This kappa is found by bisection.
  double low = 0.0, high = 0.3;
  for (int i = 0; i < 80; ++i) {
    at.kappa = 0.5 * (low + high);
    (slope(tire, at, &S::Fx, "kappa") > 0.0 ? low : high) = at.kappa;
  }
  EXPECT_NEAR(slope(tire, at, &S::Fx, "PDX1"), 4000.0, 1e-6);
}

TEST(MagicFormulaSlopes, FarSlidingTheForceIsPeakTimesTheSineOfTheShape) {
  Parameters p = round_tire();
  p.PEY1 = 0.0;
  Conventions no_limits;
  no_limits.limits = false;
  const MagicFormula tire(p, no_limits);
  State far = kCornering;
  far.alpha = 1e4;  // B alpha = 1e5, so atan(B alpha) is 1e-5 below its limit
  const double C = 1.3, angle = C * 0.5 * std::numbers::pi;
  EXPECT_NEAR(slope(tire, far, &S::Fy, "PDY1"), -4000.0 * std::sin(angle), 0.4);
  EXPECT_NEAR(
      slope(tire, far, &S::Fy, "PCY1"), -0.5 * std::numbers::pi * 4000.0 * std::cos(angle), 0.4);
}

TEST(MagicFormulaSlopes, StiffnessesAreSlopesOfForcesInSlip) {
  for (const Version version : kVersions) {
    Parameters p = round_tire();
    p.version = version;
    const MagicFormula tire(p);
    State rolling = kCornering;
    rolling.alpha = 0.0;
    const SteadyState s = tire.evaluate(rolling);
    // Equations (4.E16) and (4.E26) divide by D + 1e-6, so the slope differs slightly from the
    // stiffness.
    EXPECT_NEAR(slope(tire, rolling, &S::Fx, "kappa"), s.Kxk, 1e-9 * s.Kxk);
    EXPECT_NEAR(slope(tire, rolling, &S::Fy, "alpha"), s.Kya, -1e-9 * s.Kya);
  }
}

// If all loads and stiffnesses grow by a factor, all forces grow by that factor. By Euler's theorem
// on homogeneous functions the derivatives weighted with their variables then add up to the force.
TEST(MagicFormulaSlopes, ForcesAreHomogeneousInForces) {
  const std::vector<std::string> variables = {"Fz",
                                              "FNOMIN",
                                              "FZMIN",
                                              "FZMAX",
                                              "VERTICAL_STIFFNESS",
                                              "LONGITUDINAL_STIFFNESS",
                                              "LATERAL_STIFFNESS"};
  const std::vector<Output> outputs = {&S::Fx, &S::Fy, &S::Mx, &S::My, &S::Mz, &S::Kya, &S::Cz};
  for (const Version version : kVersions) {
    const Parameters p = full_tire(version);
    const MagicFormula tire(p);
    const std::vector<State> states = varied_states(40);
    const SteadyStateSlopes found = steady_state_slopes(tire, states, variables, outputs);
    for (std::size_t i = 0; i < states.size(); ++i)
      for (std::size_t o = 0; o < outputs.size(); ++o) {
        const auto& s = found.slopes[o];
        double sum = states[i].Fz * s(i, 0);
        for (std::size_t j = 1; j < variables.size(); ++j)
          sum += p.*find_parameter(variables[j])->member * s(i, j);
        const double value = found.values(i, o);
        EXPECT_NEAR(sum, value, 1e-6 * (1.0 + std::abs(value))) << i << " " << o;
      }
  }
}

TEST(MagicFormulaSlopes, WhatHasNoEffectHasNoSlope) {
  const MagicFormula tire(round_tire());
  for (const char* name : {"PCX1", "QDZ1", "MASS", "RIM_WIDTH", "QSY1", "Q_CAM1", "LMX"})
    EXPECT_EQ(slope(tire, kCornering, &S::Fy, name), 0.0) << name;
  EXPECT_EQ(slope(tire, kCornering, &S::Fx, "PKY1"), 0.0);
}

TEST(MagicFormulaSlopes, CoefficientsThatAreZeroHaveTheirSlope) {
  const Parameters p = round_tire();
  for (const auto& [name, output] : std::vector<std::pair<std::string, Output>>{{"QSX4", &S::Mx},
                                                                                {"QSX10", &S::Mx},
                                                                                {"LMUV", &S::Fy},
                                                                                {"QSY7", &S::My},
                                                                                {"QSY8", &S::My}}) {
    Parameters with = p;
    with.QSX6 = with.QSX8 = with.QSX9 = with.QSX11 = 0.5;
    with.QSX5 = with.QSX7 = 1.0;
    State at = kCornering;
    at.gamma = 0.04;
    at.Fz = 5000.0;
    at.p = 2.5e5;
    const MagicFormula without(with);
    constexpr double kSmall = 1e-7;
    with.*find_parameter(name)->member = kSmall;
    const double difference =
        (MagicFormula(with).evaluate(at).*output - without.evaluate(at).*output) / kSmall;
    EXPECT_NE(difference, 0.0) << name;
    EXPECT_NEAR(slope(without, at, output, name), difference, 1e-5 * std::abs(difference)) << name;
  }
}

TEST(MagicFormulaSlopes, AtAKinkThoseOfTheSideThatIsSaid) {
  Parameters p = round_tire();
  p.QSX14 = 0.02;
  p.ALPMAX = 0.08;
  const MagicFormula tire(p);
  // The derivative of |gamma| at gamma = 0 is that for increasing gamma, so the term Fy |gamma|
  // contributes.
  State rising = kCornering;
  rising.alpha = 0.05;
  const State upright = rising;
  rising.gamma = 1e-7;
  const double to_the_right = (tire.evaluate(rising).Mx - tire.evaluate(upright).Mx) / 1e-7;
  EXPECT_NEAR(slope(tire, upright, &S::Mx, "gamma"), to_the_right, 1e-4 * std::abs(to_the_right));
  // At the limit of a clamped input the derivative is that of the clamped side, which is zero.
  State clamped = kCornering;
  EXPECT_EQ(slope(tire, clamped, &S::Fy, "alpha"), 0.0);
  p.ALPMAX = 0.09;
  EXPECT_DOUBLE_EQ(slope(tire, clamped, &S::Fy, "ALPMAX"),
                   slope(MagicFormula(p), clamped, &S::Fy, "alpha"));
}

// If PEY1 or QEZ1 has reached its bound E = 1 in a fit, the derivative must be that of the side E <
// 1, so that the fit can leave the bound.
TEST(MagicFormulaSlopes, AtTheLargestCurvatureFactorThoseOfTheWayBack) {
  constexpr double kStep = 1e-6;
  for (const auto& [name, output] : {std::pair{"PEY1", &S::Fy}, std::pair{"QEZ1", &S::Mz}}) {
    Parameters p;
    p.UNLOADED_RADIUS = 0.3;
    p.FNOMIN = 4000.0;
    p.VERTICAL_STIFFNESS = 2e5;
    p.NOMPRES = p.INFLPRES = 2.2e5;
    p.PCY1 = 1.3;
    p.PDY1 = 1.0;
    p.PKY1 = -15.0;
    p.PKY2 = 1.5;
    p.QBZ1 = 10.0;
    p.QCZ1 = 1.1;
    p.QDZ1 = 0.1;
    p.*find_parameter(name)->member = 1.0;
    const MagicFormula at_one(p);
    p.*find_parameter(name)->member = 1.0 - kStep;
    State state{4000.0, 0.0, 0.08, 0.0, 0.0, 16.7, 2.2e5};
    const double back =
        (at_one.evaluate(state).*output - MagicFormula(p).evaluate(state).*output) / kStep;
    EXPECT_NE(back, 0.0) << name;
    EXPECT_NEAR(slope(at_one, state, output, name), back, 1e-4 * std::abs(back)) << name;
  }
}

TEST(MagicFormulaSlopes, FiniteWhereverAWheelCanBe) {
  std::vector<std::string> variables = {"Fz", "kappa", "alpha", "gamma", "phit", "Vx", "p"};
  for (const ParameterField& field : parameter_fields())
    if (field.name != "VXLOW" && field.name != "FZMIN") variables.emplace_back(field.name);
  for (int convention = 0; convention < 4; ++convention) {
    Conventions c;
    c.limits = convention & 1;
    c.turn_slip = convention & 2;
    for (const Version version : kVersions) {
      Parameters p = round_tire();
      p.version = version;
      std::vector<State> states;
      for (int i = 0; i < 64; ++i)
        states.push_back({i & 1 ? 0.0 : 4000.0,
                          i & 2 ? -1.0 : 0.0,
                          i & 4 ? 0.1 : 0.0,
                          i & 8 ? 0.05 : 0.0,
                          i & 16 ? 0.1 : 0.0,
                          i & 32 ? 0.0 : 10.0,
                          2.2e5});
      const auto found = steady_state_slopes(MagicFormula(p, c), states, variables, all_outputs());
      for (std::size_t o = 0; o < all_outputs().size(); ++o)
        for (Eigen::Index i = 0; i < 64; ++i)
          for (std::size_t j = 0; j < variables.size(); ++j)
            EXPECT_TRUE(std::isfinite(found.slopes[o](i, j)))
                << "output " << o << " state " << i << " " << variables[j] << " convention "
                << convention << " version " << static_cast<int>(version);
    }
  }
}

TEST(MagicFormulaSlopes, OneStateAsManyAnyVariablesAskedTwiceAnyOrder) {
  const MagicFormula tire(full_tire(Version::mf62));
  const std::vector<State> states = varied_states(13);
  std::vector<std::string> variables = {"PKY1", "alpha", "PKY1"};
  for (const ParameterField& field : parameter_fields()) variables.emplace_back(field.name);
  const auto all = steady_state_slopes(tire, states, variables, all_outputs());
  for (const std::string name : {"PKY1", "LFZO", "QDZ1", "Q_FCY", "alpha"})
    for (std::size_t o = 0; o < all_outputs().size(); ++o)
      for (std::size_t i = 0; i < states.size(); ++i)
        for (std::size_t j = 0; j < variables.size(); ++j) {
          if (variables[j] != name) continue;
          const double alone = slope(tire, states[i], all_outputs()[o], name);
          // The deflection is solved to 1e-15 m, and the search may approach it from either end.
          EXPECT_NEAR(all.slopes[o](i, j), alone, 1e-11 * std::abs(alone)) << name << o;
        }
  EXPECT_EQ(steady_state_slopes(tire, {}, variables, all_outputs()).slopes[0].rows(), 0);
  EXPECT_EQ(steady_state_slopes(tire, states, {}, all_outputs()).slopes[0].cols(), 0);
}

TEST(MagicFormulaSlopes, EveryKernelSetGivesTheSame) {
  const MagicFormula tire(full_tire(Version::mf61));
  const std::vector<State> states = varied_states(50);
  const std::vector<std::string> variables = {"PKY1", "PDY1", "QDZ1", "FNOMIN", "LMUY", "alpha"};
  const std::vector<Output> outputs = {&S::Fy, &S::Mz};
  const auto by = [&](KernelSet set) {
    const WithKernelSet with(set);
    return steady_state_slopes(tire, states, variables, outputs);
  };
  const auto best = by(kernel_sets().back());
  for (const KernelSet set : kernel_sets()) {
    const auto here = by(set);
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      const double scale = best.slopes[o].colwise().norm().maxCoeff();
      EXPECT_LE((here.slopes[o] - best.slopes[o]).norm(), 1e-11 * scale) << name(set);
      if (set == KernelSet::baseline) continue;
      EXPECT_EQ(here.slopes[o], best.slopes[o]) << name(set);
    }
  }
}

TEST(MagicFormulaSlopes, NamesThatAreNoneNameTheNearest) {
  const MagicFormula tire(round_tire());
  try {
    slope(tire, kCornering, &S::Fy, "PKY11");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"PKY1\""), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace latsch::magic_formula
