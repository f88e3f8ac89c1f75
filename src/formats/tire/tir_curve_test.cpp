// SPDX-License-Identifier: Apache-2.0
// Tests curves of a .tir that are refused or doubted, and numbers that no tire has.
#include "formats/tire/tir_curve.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace latsch::formats {
namespace {

const std::string kPlainFile =
    "[UNITS]\nLENGTH='m'\nFORCE='N'\nANGLE='radians'\nMASS='kg'\nTIME='second'\n"
    "PRESSURE='Pa'\n[MODEL]\nFITTYP=61\n[DIMENSION]\nUNLOADED_RADIUS=0.3\n"
    "[VERTICAL]\nFNOMIN=4000\nVERTICAL_STIFFNESS=2e5\n";

TirFile with_curve(const std::string& rows, const std::string& more = "") {
  return parse_tir(kPlainFile + more + "[DEFLECTION_LOAD_CURVE]\n" + rows, "t.tir");
}

std::string curve_refusal(const std::string& rows) {
  try {
    with_curve(rows);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool is_doubted(const TirFile& tir, const std::string& part) {
  return std::ranges::any_of(tir.doubts, [&](const auto& doubt) {
    return doubt.sentence.find(part) != std::string::npos;
  });
}

void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(LoadCurveOfATir, ARisingCurveOfTwoColumnsIsRead) {
  const TirFile tir = with_curve("{pen fz}\n0 0\n0.01 2000\n0.03 6500\n");
  EXPECT_EQ(tir.parameters.curve_deflection, (std::vector{0.0, 0.01, 0.03}));
  EXPECT_EQ(tir.parameters.curve_force, (std::vector{0.0, 2000.0, 6500.0}));
  EXPECT_FALSE(is_doubted(tir, "DEFLECTION_LOAD_CURVE"));
}

TEST(LoadCurveOfATir, OtherCurvesAreRefusedWithTheirLine) {
  expect_in(curve_refusal("0 0\n0.01 5000\n0.02 2000\n"),
            "t.tir:18: [DEFLECTION_LOAD_CURVE] does not rise");
  expect_in(curve_refusal("0 0\n0.01 5000\n0.02 5000\n"), "does not rise");
  expect_in(curve_refusal("0 0\n0.01 2000\n0.01 3000\n"), "does not rise");
  expect_in(curve_refusal("0 0 0\n0.01 2000 1\n"), "has 3 numbers, expected two");
  expect_in(curve_refusal("{pen fz x}\n0 0\n0.01 2000\n"), "are {PEN FZ X}, expected {pen fz}");
  expect_in(curve_refusal("{fz pen}\n0 0\n2000 0.01\n"), "expected {pen fz}");
  expect_in(curve_refusal("0 500\n0.01 2000\n"), "begins with 500 N");
  expect_in(curve_refusal("-0.01 0\n0.01 2000\n"), "begins with");
  expect_in(curve_refusal("0 0\n10 2000\n20 5000\n"), "in millimeters");
  expect_in(curve_refusal("0 0\n0.01 2\n0.02 5\n"), "times softer than VERTICAL_STIFFNESS");
  expect_in(curve_refusal("0 0\n"), "fewer than two points");
}

TEST(LoadCurveOfATir, IsDoubtedWhereItContradictsTheFile) {
  EXPECT_TRUE(is_doubted(with_curve("0 0\n0.01 2000\n"), "below FNOMIN = 4000 N"));
  EXPECT_TRUE(is_doubted(with_curve("0 0\n0.01 4000\n0.02 9000\n"),
                         "carries FNOMIN at 10 mm, VERTICAL_STIFFNESS at 20 mm"));
  const TirFile late = with_curve("0.002 300\n0.03 6500\n");
  EXPECT_TRUE(is_doubted(late, "begins at 2 mm"));
  EXPECT_EQ(late.parameters.curve_deflection.front(), 0.0);
  EXPECT_TRUE(is_doubted(with_curve("0 0\n0.03 6500\n", "Q_FZ2=20\nPFZ1=0.7\n"),
                         "Q_FZ2, PFZ1 have no effect on it"));
  EXPECT_TRUE(is_doubted(with_curve("0 0\n0.03 6500\n[DEFLECTION_LOAD_CURVE]\n0 0\n0.02 9000\n"),
                         "a second"));
}

TEST(ForcesOfATir, ThatNoTireHasAreDoubtedByTheirCoefficient) {
  const auto doubts = [](const std::string& more, const std::string& part) {
    EXPECT_TRUE(is_doubted(parse_tir(kPlainFile + more, "t.tir"), part)) << more;
  };
  const std::string side = "[LATERAL_COEFFICIENTS]\nPCY1=1.3\nPDY1=1\nPKY2=1.5\nPKY1=";
  const std::string along = "[LONGITUDINAL_COEFFICIENTS]\nPCX1=1.6\nPDX1=1.2\nPKX1=";
  doubts(side + "8.9\n", "PKY1 is 8.9: the cornering stiffness has the wrong sign");
  doubts(along + "-20\n", "PKX1 is -20: the slip stiffness has the wrong sign");
  doubts(side + "-20\n[SCALING_COEFFICIENTS]\nLMUY=100\n", "LMUY = 100 is a friction of 100");
  doubts(along + "20\n[SCALING_COEFFICIENTS]\nLMUX=0.001\n", "LMUX = 0.001");
  doubts("BREFF=-80\nDREFF=0.3\nFREFF=0.1\n", "BREFF, DREFF and FREFF");
  doubts("BREFF=8\nDREFF=30\nFREFF=0.1\n", "BREFF, DREFF and FREFF");
  doubts("[CONTACT_PATCH]\nQ_RA1=39\n", "Q_RA1 and Q_RA2");
  const TirFile usual = parse_tir(kPlainFile + "BREFF=8\nDREFF=0.3\nFREFF=0.1\n" + side + "-20\n" +
                                      along + "20\n[CONTACT_PATCH]\nQ_RA1=0.6\n",
                                  "t.tir");
  EXPECT_TRUE(usual.doubts.empty()) << usual.doubts.front().sentence;
}

}  // namespace
}  // namespace latsch::formats
