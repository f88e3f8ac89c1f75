// SPDX-License-Identifier: Apache-2.0
// Sets every coefficient of a full MF 6.2 file to 0 and to a number close to 0. Each result must be
// finite and of the size of a tire's, or the reader must report the coefficient.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "formats/tire/tir_file.h"
#include "models/magic_formula/magic_formula.h"
#include "models/magic_formula/round_tire_testing.h"

namespace latsch::formats {
namespace {

using namespace magic_formula;

/// Returns a tire whose coefficients without unit are all different from 0.
Parameters full_62() {
  Parameters p = round_tire();
  p.version = Version::mf62;
  int i = 0;
  for (const ParameterField& field : parameter_fields())
    if (field.unit == ParameterUnit::one && std::isfinite(p.*field.member) &&
        field.section != "SCALING_COEFFICIENTS")
      p.*field.member += 0.02 + 0.001 * (++i % 30);
  p.QDZ10 = 0.5;
  p.ASPECT_RATIO = 0.5;
  p.VXLOW = 1.0;
  return p;
}

/// Returns the text of a file that states `value` for the coefficient.
std::string file_with(Parameters p, const ParameterField& field, double value) {
  p.*field.member = value;
  TirRemarks remarks;
  remarks.of_keys.emplace(std::string(field.name), "the number under test");
  return tir_text(p, remarks);
}

std::vector<State> lattice(const Parameters& p) {
  std::vector<State> states;
  for (const double load : {0.0, p.FNOMIN, 1.5 * p.FNOMIN})
    for (const double kappa : {-1.0, 0.1})
      for (const double alpha : {0.0, 0.1})
        for (const double gamma : {-0.1, 0.0})
          for (const double phit : {0.0, 0.3})
            for (const double Vx : {-10.0, 0.0, 20.0})
              states.push_back({load, kappa, alpha, gamma, phit, Vx, 0.9 * p.INFLPRES});
  return states;
}

/// Returns where a result is not finite, or where a force or moment is larger than any tire has;
/// empty if neither occurs.
std::string fault_of(const Parameters& p) {
  constexpr double kMost = 1e9;  // N, N m
  constexpr std::size_t kForces = 6;
  for (const bool turn_slip : {false, true})
    for (const bool limits : {false, true}) {
      Conventions conventions;
      conventions.turn_slip = turn_slip;
      conventions.limits = limits;
      const MagicFormula tire(p, conventions);
      for (const State& s : lattice(p)) {
        const auto fields = std::bit_cast<std::array<double, sizeof(SteadyState) / sizeof(double)>>(
            tire.evaluate(s));
        for (std::size_t i = 0; i < fields.size(); ++i)
          if (!std::isfinite(fields[i]) || (i < kForces && std::abs(fields[i]) > kMost))
            return fmt::format(
                "result {} is {:g} at Fz {:g}, kappa {:g}, alpha {:g}, gamma {:g}, "
                "phit {:g}, Vx {:g}, turn slip {}, limits {}",
                i,
                fields[i],
                s.Fz,
                s.kappa,
                s.alpha,
                s.gamma,
                s.phit,
                s.Vx,
                turn_slip,
                limits);
      }
    }
  return "";
}

bool names(const TirFile& tir, std::string_view key) {
  const auto has_key = [&](const std::string& text) { return text.find(key) != text.npos; };
  return std::ranges::any_of(tir.doubts, [&](const auto& one) { return has_key(one.sentence); }) ||
         std::ranges::any_of(tir.notes, has_key);
}

TEST(ZeroCoefficients, EveryResultIsFiniteOrTheCoefficientIsNamed) {
  const Parameters full = full_62();
  ASSERT_EQ(fault_of(parse_tir(tir_text(full), "full.tir").parameters), "");
  for (const ParameterField& field : parameter_fields())
    for (const double value : {0.0, 1e-300}) {
      const std::string text = file_with(full, field, value);
      try {
        const TirFile tir = parse_tir(text, "zero.tir");
        const std::string fault = fault_of(tir.parameters);
        if (!fault.empty() && !names(tir, field.name))
          ADD_FAILURE() << field.name << " = " << value << ": " << fault;
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(field.name), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("zero.tir:"), std::string::npos) << error.what();
      }
    }
}

TEST(ZeroCoefficients, TurnSlipWithoutHeightOfItsCurveShiftsNothing) {
  Parameters p = full_62();
  p.PHYP2 = p.PHYP3 = 0.0;
  Parameters small = p;
  small.PHYP2 = 1e-9;  // equal to the limit that missing_of_turn_slip() sets
  Conventions conventions;
  conventions.turn_slip = true;
  for (const double phit : {-0.5, 0.0, 0.3}) {
    const State s{4000.0, 0.02, 0.05, 0.03, phit, 15.0, p.INFLPRES};
    const SteadyState zero = MagicFormula(p, conventions).evaluate(s);
    const SteadyState low = MagicFormula(small, conventions).evaluate(s);
    ASSERT_TRUE(std::isfinite(zero.Fy));
    EXPECT_NEAR(zero.Fy, low.Fy, 1e-3);
    EXPECT_NEAR(zero.Mz, low.Mz, 1e-3);
  }
}

TEST(ZeroCoefficients, ALockedWheelHasNoRollingResistanceWithoutVxlow) {
  Parameters p = full_62();
  p.VXLOW = 0.0;
  const SteadyState s = MagicFormula(p).evaluate({4000.0, -1.0, 0.0, 0.0, 0.0, 10.0, p.INFLPRES});
  EXPECT_EQ(std::abs(s.My), 0.0);
}

/// Friction 0 of the road multiplies LMUY: all forces caused by slip are then 0.
TEST(ZeroCoefficients, WithoutFrictionThereIsNoForceOfSlip) {
  Parameters p = round_tire();
  p.LMUX = p.LMUY = 0.0;
  for (const double LMUV : {0.0, 0.1}) {
    p.LMUV = LMUV;
    const SteadyState s = MagicFormula(p).evaluate({4000.0, 0.1, 0.1, 0.0, 0.0, 15.0, p.INFLPRES});
    EXPECT_NEAR(s.Fx, 0.0, 1e-6);
    EXPECT_NEAR(s.Fy, 0.0, 1e-6);
    EXPECT_NEAR(s.Mz, 0.0, 1e-6);
  }
}

TEST(ZeroCoefficients, NoStiffnessAgainstSpinLeavesTurnSlipOutAndIsNamed) {
  for (const char* name : {"LKZC", "QDZ10"}) {
    Parameters p = full_62();
    p.QDZ9 = name == std::string("QDZ10") ? 0.0 : p.QDZ9;
    p.*find_parameter(name)->member = 0.0;
    EXPECT_EQ(p.missing_of_turn_slip(), name);
    Conventions conventions;
    conventions.turn_slip = true;
    EXPECT_FALSE(MagicFormula(p, conventions).conventions().turn_slip);
    EXPECT_TRUE(names(parse_tir(tir_text(p), "zero.tir"), name)) << name;
  }
}

}  // namespace
}  // namespace latsch::formats
