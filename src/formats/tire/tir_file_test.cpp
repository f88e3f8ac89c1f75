// SPDX-License-Identifier: Apache-2.0
#include "formats/tire/tir_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "base/file.h"
#include "base/spoiled_text_testing.h"
#include "formats/tire/tir_ledger.h"

namespace latsch::formats {
namespace {

using magic_formula::MeasuredSide;
using magic_formula::Parameters;
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

bool says(const TirFile& tir, const std::string& part) {
  for (const std::string& note : tir.notes)
    if (note.find(part) != std::string::npos) return true;
  for (const LedgerDoubt& doubt : tir.doubts)
    if ((doubt.place.text() + ": " + doubt.sentence).find(part) != std::string::npos) return true;
  return false;
}

/// Returns kSmall with a further line before [VERTICAL].
std::string with_line(const std::string& line) {
  return replaced("[VERTICAL]\n", line + "\n[VERTICAL]\n");
}

TEST(TirFile, ASpeedThatIsNotPositiveIsRefusedWithItsLine) {
  const std::string version = "FITTYP=61 $ version\n";
  EXPECT_EQ(tir_complaint(replaced(version, version + "LONGVL=0\n")),
            "t.tir:10: LONGVL is 0 m/s, expected a positive speed: that of the measurement, to "
            "which the forces refer");
  EXPECT_NE(tir_complaint(replaced(version, version + "LONGVL=-16700\n")).find("LONGVL is -16.7"),
            std::string::npos);
  EXPECT_NE(tir_complaint(replaced(version, version + "VXLOW=-1\n")).find("t.tir:10: VXLOW is"),
            std::string::npos);
  EXPECT_EQ(tir_complaint(replaced(version, version + "LONGVL=16700\n")), "");
}

TEST(TirFile, NegativeMassesInertiasAndDampingsAreRefused) {
  for (const char* line : {"IYY=-1",
                           "BELT_MASS=-4",
                           "DAMP_LONG=-0.1",
                           "DAMP_RESIDUAL=-0.001",
                           "FREQ_LAT=-40",
                           "YAW_STIFFNESS=-5"}) {
    const std::string complaint = tir_complaint(with_line(line));
    EXPECT_NE(complaint.find(std::string("t.tir:18: ") + std::string(line, strchr(line, '='))),
              std::string::npos)
        << complaint;
  }
  EXPECT_NE(tir_complaint(replaced("MASS=9.3", "MASS=-9.3")).find("MASS is -9.3 kg"),
            std::string::npos);
}

TEST(TirFile, GramsAndPercentAndMillisecondsAreNoticed) {
  EXPECT_TRUE(
      says(parse_tir(replaced("MASS=9.3", "MASS=9300"), "t.tir"), "t.tir:17: MASS is 9300"));
  EXPECT_TRUE(
      says(parse_tir(with_line("BELT_MASS=20"), "t.tir"), "the belt is a part of the tire"));
  EXPECT_TRUE(says(parse_tir(with_line("DAMP_LAT=11.5"), "t.tir"), "is it in percent?"));
  EXPECT_TRUE(says(parse_tir(with_line("FREQ_LONG=68000"), "t.tir"), "FREQ_LONG is 6.8e+04 Hz"));
  EXPECT_TRUE(says(parse_tir(with_line("IYY=8e8"), "t.tir"), "within UNLOADED_RADIUS"));
  EXPECT_FALSE(says(parse_tir(with_line("BELT_MASS=4.5\nDAMP_LAT=0.1"), "t.tir"), "t.tir:1"));
}

TEST(TirFile, AWidthGivesTheMassOfATireOfItsSize) {
  // The plausible mass of this tire is pi 0.3^2 0.2 m^3 times 10 to 1500 kg/m^3.
  const std::string sized = "UNLOADED_RADIUS=300\nWIDTH=200\n";
  std::string text = replaced("UNLOADED_RADIUS=300\n", sized);
  EXPECT_FALSE(says(parse_tir(text, "t.tir"), "MASS"));
  text.replace(text.find("MASS=9.3"), 8, "MASS=930");
  EXPECT_TRUE(says(parse_tir(text, "t.tir"), "a tire of this size has 0.57 to 85 kg"));
  EXPECT_TRUE(
      says(parse_tir(replaced("UNLOADED_RADIUS=300\n", "UNLOADED_RADIUS=300\nWIDTH=0\n"), "t.tir"),
           "WIDTH is 0 m"));
}

TEST(TirFile, AKeyInAnUnknownSectionAndACoefficientOfZeroAreReported) {
  EXPECT_TRUE(says(parse_tir(with_line("[FOO]\nPDY2=-0.5"), "t.tir"),
                   "t.tir:19: PDY2 is in [FOO], a section that is not known, it belongs in "
                   "[LATERAL_COEFFICIENTS]"));
  EXPECT_TRUE(says(parse_tir(replaced("PCY1=1.3", "PCY1=0"), "t.tir"),
                   "PCY1 is 0: the tire has no side force"));
  EXPECT_TRUE(says(parse_tir(replaced("PXX9=3", "PDX1=0"), "t.tir"),
                   "PDX1 is 0: the tire has no longitudinal force"));
  EXPECT_FALSE(says(parse_tir(kSmall, "t.tir"), "is 0: the tire has no"));
}

// A file of 20,000 unknown keys gave as many notes, each found in a list built anew.
TEST(TirFile, ThousandsOfUnknownKeysAreCountedInOneNoteAndListedInTheLedger) {
  constexpr int kKeys = 20'000;
  std::string lines = "[VERTICAL]\n";
  for (int i = 0; i < kKeys; ++i) lines += fmt::format("XQ_{}=1\n", i);
  const TirFile tir = parse_tir(with_line(lines), "t.tir");
  const auto is_unknown = [](const std::string& note) {
    return note.find("not known here") != note.npos;
  };
  EXPECT_EQ(std::ranges::count_if(tir.notes, is_unknown), 101);
  // kSmall has one unknown key of its own.
  EXPECT_TRUE(says(tir, fmt::format("from this line on, {} more keys", kKeys + 1 - 100)));
  const Ledger ledger = ledger_of(tir);
  EXPECT_EQ(std::ranges::count(ledger.rows, LedgerState::doubtful, &LedgerRow::state), kKeys + 1);
}

TEST(TirFile, AModeThatDoesNotExistIsReported) {
  const std::string version = "FITTYP=61 $ version\n";
  EXPECT_TRUE(says(parse_tir(replaced(version, version + "USE_MODE=99\n"), "t.tir"),
                   "expected a last digit of 0 to 5"));
  EXPECT_FALSE(says(parse_tir(replaced(version, version + "USE_MODE=125\n"), "t.tir"),
                    "expected a last digit"));
}

TEST(TirFile, UnitsBecomeSiAndTheTwoMassesStayApart) {
  const Parameters p = parse_tir(kSmall, "t.tir").parameters;
  EXPECT_DOUBLE_EQ(p.UNLOADED_RADIUS, 0.3);
  EXPECT_DOUBLE_EQ(p.FNOMIN, 4000.0);
  EXPECT_DOUBLE_EQ(p.VERTICAL_STIFFNESS, 2e5);
  EXPECT_DOUBLE_EQ(p.INFLPRES, 2.5e5);
  EXPECT_NEAR(p.ALPMAX, 0.5235987755982988, 1e-15);
  EXPECT_EQ(p.MASS, 9.3);
  EXPECT_EQ(p.side, MeasuredSide::right);
  EXPECT_EQ(p.version, Version::mf61);
  EXPECT_EQ(p.PKY4, 2.0);  // absent from the file
  EXPECT_EQ(p.LMUY, 1.0);
}

/// Returns the doubts of a file, one in each line.
std::string doubts_of(const std::string& text) {
  std::string all;
  for (const LedgerDoubt& doubt : ledger_of(parse_tir(text, "t.tir")).doubts)
    all += doubt.place.text() + ": " + doubt.sentence + "\n";
  return all;
}

TEST(TirFile, WhatIsOddIsNamed) {
  EXPECT_EQ(doubts_of(replaced("'Right'", "'Upper'")),
            "t.tir:10: TYRESIDE is \"Upper\", expected LEFT, RIGHT or SYMMETRIC; taken as LEFT\n");
  const TirFile tir = parse_tir(kSmall, "t.tir");
  ASSERT_FALSE(tir.notes.empty());
  EXPECT_EQ(tir.notes[0],
            "t.tir:25: [LATERAL_COEFFICIENTS] PXX9 is not known here; it has no effect, and an "
            "exported file keeps it");
  EXPECT_NE(std::find(tir.notes.begin(),
                      tir.notes.end(),
                      "t.tir: there is no PCX1, PDX1, PKX1; taken as 0: the tire has no "
                      "longitudinal force"),
            tir.notes.end());
}

TEST(TirFile, ComplaintsNameFileLineAndWhatWasExpected) {
  EXPECT_EQ(tir_complaint(replaced("UNLOADED_RADIUS=300\n", "")),
            "t.tir: there is no UNLOADED_RADIUS; expected it in [DIMENSION]");
  EXPECT_EQ(tir_complaint(replaced("FNOMIN=4", "FNOMIN=-4")),
            "t.tir:19: FNOMIN is -4, expected a positive number");
  EXPECT_EQ(tir_complaint(replaced("FITTYP=61", "FITTYP=63")),
            "t.tir:9: FITTYP is 63, expected 5, 6, 21, 51 or 52 (MF 5.2), 60 or 61 (MF 6.1), "
            "62 (MF 6.2)");
  EXPECT_EQ(tir_complaint(replaced("PXX9=3", "FNOMIN=5")),
            "t.tir:25: FNOMIN is 5, but line 19 says 4; keep one of them");
  EXPECT_EQ(
      tir_complaint(replaced("PCY1=1.3", "PCY1=1,3")),
      "t.tir:24: PCY1 is \"1,3\", expected a finite number; decimals are written with a point");
}

TEST(TirFile, EveryFitTypeIsTakenForWhatItIs) {
  const std::vector<std::pair<const char*, Version>> types = {{"5", Version::mf52},
                                                              {"6", Version::mf52},
                                                              {"21", Version::mf52},
                                                              {"51", Version::mf52},
                                                              {"52", Version::mf52},
                                                              {"60", Version::mf61},
                                                              {"61", Version::mf61},
                                                              {"62", Version::mf62},
                                                              {"'MF52'", Version::mf52},
                                                              {"'mf6.1'", Version::mf61},
                                                              {"62.0", Version::mf62}};
  for (const auto& [type, version] : types)
    EXPECT_EQ(
        parse_tir(replaced("FITTYP=61", std::string("FITTYP=") + type), "t.tir").parameters.version,
        version)
        << type;
  for (const char* format :
       {"pac2002", "Pac2002", "PAC2002", "MF-Tyre", "mf_tyre", "MF_05", "mf-05"})
    EXPECT_EQ(
        parse_tir(replaced("FITTYP=61", fmt::format("property_file_format='{}'", format)), "t.tir")
            .parameters.version,
        Version::mf52)
        << format;
  EXPECT_EQ(
      parse_tir(replaced("FITTYP=61", "PROPERTY_FILE_FORMAT='MF6.2'"), "t.tir").parameters.version,
      Version::mf62);
  for (const char* type : {"0", "7", "63", "6.5", "'PAC'"})
    EXPECT_NE(tir_complaint(replaced("FITTYP=61", std::string("FITTYP=") + type))
                  .find("expected 5, 6, 21, 51 or 52"),
              std::string::npos)
        << type;
}

TEST(TirFile, OtherModelsAreNamedAndRefusedWithAndWithoutAFitType) {
  const std::vector<std::pair<std::string, const char*>> formats = {{"PAC89", "of 1989"},
                                                                    {"pac94", "of 1994"},
                                                                    {"PAC-TIME", "PAC-TIME"},
                                                                    {"PAC_MC", "motorcycle"},
                                                                    {"FTire", "flexible ring"},
                                                                    {"521", "5.2.1"},
                                                                    {"5.2.1", "5.2.1"},
                                                                    {"UA", "Arizona"},
                                                                    {"Fiala", "Fiala"},
                                                                    {"CDTire", "flexible"},
                                                                    {"TMeasy", "TMeasy"}};
  for (const auto& [format, what] : formats) {
    for (const char* fit : {"", "FITTYP=6\n"}) {
      const std::string said =
          tir_complaint(replaced("FITTYP=61", fit + ("PROPERTY_FILE_FORMAT='" + format + "'")));
      EXPECT_NE(said.find("PROPERTY_FILE_FORMAT is \"" + format + "\""), std::string::npos) << said;
      EXPECT_NE(said.find(what), std::string::npos) << said;
    }
  }
  EXPECT_NE(tir_complaint(replaced("FITTYP=61", "PROPERTY_FILE_FORMAT='SWIFT-TYRE'"))
                .find("SWIFT, a rigid ring"),
            std::string::npos);
  EXPECT_EQ(tir_complaint(replaced("FITTYP=61", "PROPERTY_FILE_FORMAT='SWIFT-TYRE'\nFITTYP=21")),
            "");
  EXPECT_NE(tir_complaint(replaced("FITTYP=61", "PROPERTY_FILE_FORMAT='PACK2002'"))
                .find("did you mean \"PAC2002\""),
            std::string::npos);
  EXPECT_NE(tir_complaint(replaced("FITTYP=61", "PROPERTY_FILE_FORMAT='PAC2002'\nFITTYP=61"))
                .find("keep one of them"),
            std::string::npos);
  EXPECT_NE(tir_complaint(replaced("FITTYP=61", "TYPE='MOTORCYCLE'\nFITTYP=52")).find("motorcycle"),
            std::string::npos);
  EXPECT_NE(tir_complaint(replaced("FITTYP=61", "")).find("neither FITTYP nor"), std::string::npos);
}

TEST(TirFile, KeysOfPac2002AreTakenByTheirOtherNames) {
  std::string text = replaced("FITTYP=61", "PROPERTY_FILE_FORMAT='PAC2002'");
  text.replace(text.find("INFLPRES=2.5\nNOMPRES=2.5\n"), 25, "IP=2.0\nIP_NOM=2.5\n");
  text +=
      "[SCALING_COEFFICIENTS]\nLIP=0.8\nLCZ=1.5\n[OVERTURNING_COEFFICIENTS]\nQPX1=0.1\n"
      "[ALIGNING_COEFFICIENTS]\nQPZ1=0.2\nQPZ2=0.3\n[VERTICAL]\nQPFZ1=0.7\nQV2=0.04\n"
      "QFZ1=25\n";
  const TirFile tir = parse_tir(text, "t.tir");
  const Parameters& p = tir.parameters;
  EXPECT_DOUBLE_EQ(p.INFLPRES, 2.0e5);
  EXPECT_DOUBLE_EQ(p.NOMPRES, 0.8 * 2.5e5);
  EXPECT_DOUBLE_EQ(p.VERTICAL_STIFFNESS, 1.5 * 2e5);
  EXPECT_EQ(p.PPMX1, 0.1);
  EXPECT_EQ(p.PPZ1, 0.2);
  EXPECT_EQ(p.PPZ2, 0.3);
  EXPECT_EQ(p.PFZ1, 0.7);
  EXPECT_EQ(p.Q_V2, 0.04);
  // A value that was changed is written with the key and the scale of the original file.
  Parameters changed = p;
  changed.PPZ1 = -0.25;
  changed.Q_FCX = 0.01;
  changed.VERTICAL_STIFFNESS = 1.5 * 1.9e5;
  const std::string rewritten = tir_text(tir, changed);
  EXPECT_NE(rewritten.find("QPZ1=-0.25"), std::string::npos) << rewritten;
  EXPECT_NE(rewritten.find("VERTICAL_STIFFNESS=0.19 "), std::string::npos) << rewritten;
  EXPECT_NE(rewritten.find("QFCX1"), std::string::npos) << rewritten;
  EXPECT_EQ(parse_tir(rewritten, "r.tir").parameters.VERTICAL_STIFFNESS,
            changed.VERTICAL_STIFFNESS);
}

TEST(TirFile, EveryKeyHasARowThatSaysWhatItWasTakenFor) {
  std::string text = kSmall;
  text +=
      "[TURNSLIP_COEFFICIENTS]\nPDYP1=0.4\n[VERTICAL]\nDYNAMIC_STIFFNESS=1\nQFZ1=0\n"
      "BOTTOMING_RADIUS=10\n[MODEL]\nFE_METHOD='YES'\nFILE_NOTE='x'\n[BOTTOMING_CURVE]\n"
      "{pen fz}\n0 0\n1 1\n[ALIGNING_COEFFICIENTS]\nPDY1=1\nQDZI=1\n";
  const TirFile tir = parse_tir(text, "t.tir");
  std::size_t entries = 0;
  for (const auto& section : tir.source.sections()) entries += section.entries().size();
  EXPECT_EQ(tir.keys.size(), entries + 2);  // entries and the tables SHAPE, BOTTOMING_CURVE
  const auto remark = [&](const std::string& key) {
    for (const TirKey& row : tir.keys)
      if (row.key == key) return row.parameter + "|" + row.remark;
    return std::string("none");
  };
  EXPECT_EQ(remark("PCY1"), "PCY1|");
  EXPECT_EQ(remark("PDYP1"), "PDYP1|acts in turn slip (USE_MODE 5, turn_slip = \"on\")");
  EXPECT_EQ(remark("PXX9"), "|is not known here");
  EXPECT_NE(remark("FE_METHOD").find("friction ellipse"), std::string::npos);
  const Ledger ledger = ledger_of(tir);
  const auto is_assumed = [](const LedgerRow& row) { return row.state == LedgerState::assumed; };
  EXPECT_EQ(ledger.rows.size() - std::ranges::count_if(ledger.rows, is_assumed), tir.keys.size());
  EXPECT_EQ(ledger.find_written("PCY1")->state, LedgerState::used);
  EXPECT_EQ(ledger.find_written("PXX9")->state, LedgerState::doubtful);
  EXPECT_EQ(ledger.find_written("FE_METHOD")->state, LedgerState::not_used);
  EXPECT_EQ(ledger.find_written("UNLOADED_RADIUS")->factor, 1e-3);
  const auto told = [&](const std::string& part) {
    for (const std::string& note : tir.notes)
      if (note.find(part) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(told("DYNAMIC_STIFFNESS = 1 has no effect"));
  EXPECT_TRUE(told("FE_METHOD = YES has no effect"));
  EXPECT_FALSE(told("QFZ1"));  // a value of 0 has no effect
  EXPECT_TRUE(told("[BOTTOMING_CURVE] holds a table that is not read"));
  EXPECT_TRUE(told("PDY1 is in [ALIGNING_COEFFICIENTS], it belongs in [LATERAL_COEFFICIENTS]"));
  EXPECT_TRUE(
      told("QDZI is not known here; it has no effect, and an exported file keeps it, did you mean "
           "\"QDZ1\"?"));
  EXPECT_TRUE(told("FILE_NOTE is not known"));
  EXPECT_TRUE(told("ANGLE is no radian"));
}

TEST(TirFile, ScalesRangesAndStrayLinesAreCheckedForWhatTheyMean) {
  const auto with = [](const std::string& more) { return kSmall + more; };
  for (const char* scale : {"LFZO", "LCX", "LMUX", "LKX", "LCY", "LMUY", "LKY"})
    EXPECT_NE(
        tir_complaint(with(fmt::format("[SCALING_COEFFICIENTS]\n{} = 0\n", scale)))
            .find(std::string(scale) + " is 0: a scaling factor that the equations divide by"),
        std::string::npos)
        << scale;
  for (const char* scale : {"LIP = 0", "LCZ = -1"})
    EXPECT_NE(tir_complaint(with(std::string("[SCALING_COEFFICIENTS]\n") + scale + "\n"))
                  .find("expected a number above 0"),
              std::string::npos);
  const TirFile quiet = parse_tir(with("[SCALING_COEFFICIENTS]\nLTR = 0\nLHY = 0\n"), "t.tir");
  bool told = false;
  for (const std::string& note : quiet.notes)
    told = told || note.find("LHY, LTR are 0: what they scale is left out") != std::string::npos;
  EXPECT_TRUE(told);
  EXPECT_NE(
      tir_complaint(replaced("ALPMAX=30", "ALPMIN=40\nALPMAX=30")).find("ALPMIN is above ALPMAX"),
      std::string::npos);
  EXPECT_NE(tir_complaint(replaced("[VERTICAL]\nFNOMIN=4", "[UNITS]\nFNOMIN=4"))
                .find("FNOMIN is in [UNITS], expected [VERTICAL]"),
            std::string::npos);
  EXPECT_NE(tir_complaint(replaced("[UNITS]\n", "[DIMENSION]\n"))
                .find("is a unit and stands in [DIMENSION]"),
            std::string::npos);
  EXPECT_NE(tir_complaint(with("[DIMENSION]\nTYRESIDE='LEFT'\n")).find("expected [MODEL]"),
            std::string::npos);
  // A key that occurs twice with equal values is reported; with different values the file is
  // refused, even if the key is not used.
  EXPECT_NE(tir_complaint(with("[VERTICAL]\nXYZ = 1\nXYZ = 2\n")).find("keep one of them"),
            std::string::npos);
  EXPECT_NE(tir_complaint(with("[MODEL]\nTYRESIDE='LEFT'\n")).find("keep one of them"),
            std::string::npos);
  EXPECT_NE(tir_complaint(with("[DIMENSION]\nRIM_RADIUS = 2000\n"))
                .find("expected less than UNLOADED_RADIUS"),
            std::string::npos)
      << tir_complaint(with("[DIMENSION]\nRIM_RADIUS = 2000\n"));
}

TEST(TirFile, CoefficientsOfAnotherVersionAreNotUsedAndTold) {
  const auto ledger_with = [](const std::string& version, const std::string& coefficients) {
    std::string text = replaced("FITTYP=61 $ version", "FITTYP=" + version);
    text.replace(text.find("PCY1"), 4, coefficients + "PCY1");
    return ledger_of(parse_tir(text, "t.tir"));
  };
  const auto doubt = [](const Ledger& ledger) {
    for (const LedgerDoubt& one : ledger.doubts)
      if (one.sentence.find("is FITTYP right?") != std::string::npos) return one.sentence;
    return std::string();
  };
  const std::string of_61 = "PKY6=-2\nPKY7=0\n", of_52 = "PHY3=0.03\nPTY1=2\n";
  EXPECT_EQ(doubt(ledger_with("61", "LGAZ=1\nLSGAL=1\n")), "");
  EXPECT_EQ(
      doubt(ledger_with("61", "LGAZ=0.8\nLSGAL=0.9\n")),
      "LGAZ, LSGAL have no effect in MF 6.1 and 6.2, which the file states: is FITTYP right?");
  EXPECT_EQ(doubt(ledger_with("61", of_61)), "");
  EXPECT_EQ(doubt(ledger_with("52", of_52)), "");
  const Ledger old = ledger_with("52", of_61), recent = ledger_with("61", of_52);
  EXPECT_EQ(doubt(old), "PKY6 has no effect in MF 5.2, which the file states: is FITTYP right?");
  EXPECT_EQ(doubt(recent),
            "PHY3, PTY1 have no effect in MF 6.1 and 6.2, which the file states: is FITTYP right?");
  for (const char* key : {"PKY6", "PKY7"}) {
    EXPECT_EQ(old.find_written(key)->state, LedgerState::not_used) << key;
    EXPECT_TRUE(old.find_written(key)->used_by.empty()) << key;
  }
  EXPECT_EQ(recent.find_written("PTY1")->state, LedgerState::not_used);
  EXPECT_EQ(recent.find_written("PCY1")->state, LedgerState::used);
}

TEST(TirFile, AFileWithoutUnitsAndAMirroredModeAreTold) {
  std::string text = kSmall;
  text.erase(0, text.find("[MODEL]"));
  text.replace(text.find("TYRESIDE"), 8, "USE_MODE=-12\nTYRESIDE");
  const TirFile tir = parse_tir(text, "t.tir");
  EXPECT_EQ(tir.parameters.use_mode, 12);
  EXPECT_NE(doubts_of(text).find("there is no section [UNITS]; all numbers are taken as SI"),
            std::string::npos);
  EXPECT_NE(doubts_of(text).find("USE_MODE is -12: the minus asks for the tire's mirror image"),
            std::string::npos);
}

TEST(TirFile, EachUnitThatIsAssumedStandsInTheLedger) {
  EXPECT_EQ(doubts_of(kSmall), "");
  std::string text = kSmall;
  const std::size_t at = text.find("LENGTH");
  text.erase(at, text.find('\n', at) + 1 - at);
  EXPECT_NE(doubts_of(text).find("[UNITS] is silent: LENGTH is taken as meter"), std::string::npos);
  // The radius, 0.3 m, is written as 300 without the unit mm.
  EXPECT_NE(doubts_of(text).find("UNLOADED_RADIUS is 300 m, where tires have"), std::string::npos);
  const Ledger ledger = ledger_of(parse_tir(text, "t.tir"));
  ASSERT_NE(ledger.find_taken("LENGTH"), nullptr);
  EXPECT_EQ(ledger.find_taken("LENGTH")->state, LedgerState::assumed);
  EXPECT_NE(in_one_line(ledger).find(" assumed: LENGTH is taken as meter"), std::string::npos);
}

TEST(TirFile, NumbersAssumedForAWheelAtRestStandInTheLedger) {
  const Ledger ledger = ledger_of(parse_tir(kSmall, "t.tir"));
  for (const char* name : {"VXLOW", "DAMP_VLOW", "QCRP1", "YAW_STIFFNESS"}) {
    ASSERT_NE(ledger.find_taken(name), nullptr) << name;
    EXPECT_EQ(ledger.find_taken(name)->state, LedgerState::assumed) << name;
  }
  const Ledger stated = ledger_of(parse_tir(
      kSmall + "[STRUCTURAL]\nYAW_STIFFNESS=0.08\nDAMP_VLOW=0.002\n[TURNSLIP_COEFFICIENTS]\n"
               "QCRP1=0.2\n[MODEL]\nVXLOW=1000\n",
      "t.tir"));
  EXPECT_NE(stated.find_taken("YAW_STIFFNESS")->state, LedgerState::assumed);
  EXPECT_EQ(in_one_line(stated).find("assumed"), std::string::npos) << in_one_line(stated);
}

TEST(TirFile, APressureUnitFromForceAndLengthStandsInTheLedger) {
  std::string text = replaced("PRESSURE='bar'\n", "");
  text.replace(text.find("INFLPRES=2.5\nNOMPRES=2.5"), 24, "INFLPRES=2.5e-4\nNOMPRES=2.5e-4");
  const Ledger ledger = ledger_of(parse_tir(text, "t.tir"));
  ASSERT_NE(ledger.find_taken("PRESSURE"), nullptr);
  EXPECT_NE(ledger.find_taken("PRESSURE")->remark.find("FORCE/LENGTH^2, 1000000000 Pa"),
            std::string::npos)
      << ledger.find_taken("PRESSURE")->remark;
}

TEST(TirFile, ARangeInDegreesBesideRadiansIsTold) {
  const auto with_range = [](const std::string& angle, const std::string& range) {
    std::string text = kSmall;
    const std::size_t at = text.find("ANGLE");
    text.replace(at, text.find('\n', at) - at, "ANGLE = '" + angle + "'");
    return text.replace(text.find("ALPMAX=30"), 9, range);
  };
  const std::string said = doubts_of(with_range("radians", "ALPMIN=-15\nALPMAX=15"));
  EXPECT_NE(said.find("ALPMIN is -15 rad, that are -859 degrees: is it in degrees"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("-15 degrees are -0.2618"), std::string::npos) << said;
  EXPECT_NE(doubts_of(with_range("radians", "CAMMIN=-6\nCAMMAX=6")).find("CAMMIN is -6 rad"),
            std::string::npos);
  EXPECT_EQ(doubts_of(with_range("degrees", "ALPMIN=-15\nALPMAX=15")), "");
  EXPECT_EQ(doubts_of(with_range("radians", "ALPMIN=-3.15\nALPMAX=3.15")), "");
  EXPECT_NE(doubts_of(with_range("degrees", "ALPMAX=15\nKPUMAX=150")).find("is it in percent"),
            std::string::npos);
  EXPECT_EQ(doubts_of(with_range("degrees", "ALPMAX=15\nKPUMAX=1.5")), "");
}

TEST(TirFile, ACoefficientWithoutWhichSlipsDoNotActOnEachOtherIsTold) {
  const auto notes_with = [](const std::string& coefficients) {
    std::string all;
    for (const std::string& note : parse_tir(kSmall + coefficients, "t.tir").notes)
      all += note + "\n";
    return all;
  };
  const std::string forces =
      "[LATERAL_COEFFICIENTS]\nPDY1 = 1\n[LONGITUDINAL_COEFFICIENTS]\nPDX1 = 1.1\nRBX1 = "
      "12\n%1[LATERAL_COEFFICIENTS]\nRBY1 = 10\n%2";
  const auto told = [&](const std::string& x, const std::string& y) {
    std::string text = forces;
    text.replace(text.find("%1"), 2, x);
    text.replace(text.find("%2"), 2, y);
    return notes_with(text);
  };
  const std::string none = told("", ""), whole = told("RCX1 = 1\n", "RCY1 = 1\n");
  EXPECT_NE(none.find("RCX1 is 0 or missing, so that steering does not diminish"), none.npos)
      << none;
  EXPECT_NE(none.find("RCY1 is 0 or missing, so that braking does not diminish"), none.npos)
      << none;
  EXPECT_EQ(whole.find("is 0 or missing"), whole.npos) << whole;
}

TEST(TirFile, AUseModeThatIsNotComputedIsTold) {
  const auto in_mode = [](int mode) {
    std::string text = kSmall;
    return text.replace(text.find("TYRESIDE"), 8, fmt::format("USE_MODE={}\nTYRESIDE", mode));
  };
  for (const int mode : {4, 14, 114}) EXPECT_EQ(doubts_of(in_mode(mode)), "") << mode;
  for (const auto& [mode, asked] : std::vector<std::pair<int, std::string>>{
           {0, "asks for the vertical force alone, in steady state; all forces are computed here"},
           {1, "asks for Fx and My without side force"},
           {12, "asks for Fy, Mx and Mz without longitudinal force, with relaxation"},
           {3, "asks for all forces without interaction of the slips"},
           {15, "turn slip is computed only if a test asks for it"},
           {24, "the relaxation lengths here do not depend on the slip"},
           {134, "a belt is computed here only in a model of kind = \"rigid_ring\""},
           {214, "the contact with the road is that of the model here"}})
    EXPECT_NE(doubts_of(in_mode(mode)).find(asked), std::string::npos)
        << mode << " " << doubts_of(in_mode(mode));
  const Ledger ledger = ledger_of(parse_tir(in_mode(14), "t.tir"));
  EXPECT_NE(ledger.find_written("USE_MODE")->meaning.find("all forces in combined slip"),
            std::string::npos);
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
  EXPECT_EQ(mf61.parameters.side, MeasuredSide::right);
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
