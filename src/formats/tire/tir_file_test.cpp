// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_file.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/file.h"
#include "base/spoiled_text_testing.h"

namespace latsch::formats {
namespace {

using magic_formula::Parameters;
using magic_formula::Side;
using magic_formula::Version;

const std::filesystem::path kTires = LATSCH_SOURCE_DIR "/../shared/data/tir";

const std::string kSmall =
    "[UNITS]\nLENGTH='mm'\nFORCE='kN'\nANGLE='degrees'\nMASS='kg'\nTIME='second'\nPRESSURE='bar'\n"
    "[MODEL]\nFITTYP=61 $ version\nTYRESIDE='Right'\n"
    "[DIMENSION]\nUNLOADED_RADIUS=300\n"
    "[OPERATING_CONDITIONS]\nINFLPRES=2.5\nNOMPRES=2.5\n"
    "[INERTIA]\nMASS=9.3\n"
    "[VERTICAL]\nFNOMIN=4\nVERTICAL_STIFFNESS=0.2 $ kN/mm\n"
    "[SLIP_ANGLE_RANGE]\nALPMAX=30\n"
    "[LATERAL_COEFFICIENTS]\nPCY1=1.3\nPXX9=3\n"
    "[SHAPE]\n{radial width}\n1.0 0.0\n0.9 1.0\n";

std::string tir_complaint(const std::string& text) {
  try {
    parse_tir(text, "t.tir");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(const std::string& what, const std::string& with) {
  std::string text = kSmall;
  text.replace(text.find(what), what.size(), with);
  return text;
}

void expect_same(const Parameters& a, const Parameters& b) {
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.use_mode, b.use_mode);
  EXPECT_EQ(a.curve_deflection, b.curve_deflection);
  EXPECT_EQ(a.curve_force, b.curve_force);
  for (const auto& field : magic_formula::parameter_fields())
    EXPECT_EQ(a.*field.member, b.*field.member) << field.name;
}

TEST(TirFile, UnitsBecomeSiAndTheTwoMassesStayApart) {
  const Parameters p = parse_tir(kSmall, "t.tir").parameters;
  EXPECT_DOUBLE_EQ(p.UNLOADED_RADIUS, 0.3);
  EXPECT_DOUBLE_EQ(p.FNOMIN, 4000.0);
  EXPECT_DOUBLE_EQ(p.VERTICAL_STIFFNESS, 2e5);
  EXPECT_DOUBLE_EQ(p.INFLPRES, 2.5e5);
  EXPECT_NEAR(p.ALPMAX, 0.5235987755982988, 1e-15);
  EXPECT_EQ(p.MASS, 9.3);
  EXPECT_EQ(p.side, Side::right);
  EXPECT_EQ(p.version, Version::mf61);
  EXPECT_EQ(p.PKY4, 2.0);  // what the file leaves out
  EXPECT_EQ(p.LMUY, 1.0);
}

TEST(TirFile, WhatIsOddIsNamed) {
  EXPECT_EQ(parse_tir(replaced("'Right'", "'Upper'"), "t.tir").notes.at(1),
            "t.tir:10: TYRESIDE is \"Upper\", expected LEFT, RIGHT or SYMMETRIC; taken as LEFT");
  const TirFile tir = parse_tir(kSmall, "t.tir");
  ASSERT_FALSE(tir.notes.empty());
  EXPECT_EQ(
      tir.notes[0],
      "t.tir:25: [LATERAL_COEFFICIENTS] PXX9 is not known here; it stays in the file, without "
      "effect");
  EXPECT_NE(std::find(tir.notes.begin(), tir.notes.end(), "t.tir: there is no PCX1; taken as 0"),
            tir.notes.end());
}

TEST(TirFile, ComplaintsNameFileLineAndWhatWasExpected) {
  EXPECT_EQ(tir_complaint(replaced("UNLOADED_RADIUS=300\n", "")),
            "t.tir: there is no UNLOADED_RADIUS; it stands in [DIMENSION]");
  EXPECT_EQ(tir_complaint(replaced("FNOMIN=4", "FNOMIN=-4")),
            "t.tir:19: FNOMIN is -4, expected a positive number");
  EXPECT_EQ(tir_complaint(replaced("FITTYP=61", "FITTYP=63")),
            "t.tir:9: FITTYP is 63, expected 6 or 21 (MF 5.2), 61 or 62");
  EXPECT_EQ(tir_complaint(replaced("PXX9=3", "FNOMIN=5")),
            "t.tir:25: FNOMIN is 5, but line 19 says 4; keep one of them");
  EXPECT_EQ(
      tir_complaint(replaced("PCY1=1.3", "PCY1=1,3")),
      "t.tir:24: PCY1 is \"1,3\", expected a finite number; decimals are written with a point");
}

TEST(TirFile, ANewFileAndAChangedOneReadBackTheSame) {
  TirFile tir = parse_tir(kSmall, "t.tir");
  Parameters p = tir.parameters;
  p.PCY1 = 1.2345678901234567;
  p.PKY1 = -21.5;  // not in the file
  p.curve_deflection = {0.0, 0.01};
  p.curve_force = {0.0, 2100.0};
  expect_same(parse_tir(tir_text(p), "new.tir").parameters, p);
  p.curve_deflection.clear();
  p.curve_force.clear();
  const std::string changed = tir_text(tir, p);
  expect_same(parse_tir(changed, "changed.tir").parameters, p);
  EXPECT_NE(changed.find("PXX9=3"), std::string::npos);
  EXPECT_EQ(tir_text(tir, tir.parameters), kSmall);
}

TEST(TirFile, SampleFilesOfOtherPrograms) {
  if (!std::filesystem::exists(kTires)) GTEST_SKIP() << "no tires in " << kTires;
  const auto read = [](const char* name) { return read_tir(kTires / name); };
  const TirFile mf61 = read("MagicFormula61_Parameters.tir");
  EXPECT_EQ(mf61.parameters.version, Version::mf61);
  EXPECT_EQ(mf61.parameters.side, Side::right);
  EXPECT_EQ(mf61.parameters.MASS, 17.451);
  EXPECT_EQ(mf61.parameters.use_mode, 124);
  EXPECT_TRUE(mf61.parameters.turn_slip_known());
  EXPECT_TRUE(mf61.notes.empty()) << mf61.notes[0];
  EXPECT_EQ(read("MagicFormula62_Parameters.tir").parameters.version, Version::mf62);
  EXPECT_EQ(read("MagicFormula52_Parameters.tir").parameters.PHY3, 0.006973);
  const TirFile chrono = read("chrono_HMMWV_Pac02Tire.tir");
  EXPECT_EQ(chrono.parameters.version, Version::mf52);
  EXPECT_EQ(chrono.parameters.NOMPRES, 8e5);
  EXPECT_GT(read("chrono_335_65R22_5_G275MSA_60psi.tir").parameters.curve_force.size() +
                chrono.parameters.curve_force.size() +
                read("chrono_Sedan_Pac02Tire.tir").parameters.curve_force.size(),
            2u);
  for (const auto& entry : std::filesystem::directory_iterator(kTires)) {
    const TirFile tir = read_tir(entry.path());
    EXPECT_EQ(tir_text(tir, tir.parameters), read_text_file(entry.path()));
    expect_same(parse_tir(tir_text(tir.parameters), "new.tir").parameters, tir.parameters);
  }
}

TEST(TirFile, SpoiledFilesEndInATireOrAComplaint) {
  int tires = 0;
  for (int i = 0; i < 2000; ++i) {
    RandomStream random(5, i);
    tires += tir_complaint(spoiled(kSmall, {"[MODEL]", "FITTYP=6\n", "1e309", "=", "'"}, random))
                 .empty();
  }
  EXPECT_GT(tires, 0);
  EXPECT_LT(tires, 2000);
}

}  // namespace
}  // namespace latsch::formats
