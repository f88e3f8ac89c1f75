// SPDX-License-Identifier: Apache-2.0
#include "formats/car/bus_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/spoiled_text_testing.h"

namespace latsch::formats {
namespace {

using multibody::BushingParameters;
using multibody::ElasticCurve;
using multibody::ForceCharacteristic;

/// The units are the usual ones of such files: mm, degrees, newton.
const char* const kRubber = R"($ a lower arm's rear bushing
[MDI_HEADER]
 FILE_TYPE     =  'bus'
 FILE_VERSION  =  4.0
 FILE_FORMAT   =  'ASCII'
[UNITS]
 LENGTH  =  'mm'
 ANGLE   =  'degrees'
 FORCE   =  'newton'
 MASS    =  'kg'
 TIME    =  'second'
[DAMPING]
 FX_DAMPING  =  3.0
 FY_DAMPING  =  0
 FZ_DAMPING  =  1.5
 TX_DAMPING  =  100.0
 TY_DAMPING  =  0
 TZ_DAMPING  =  0
[FX_CURVE]
{ x    fx}
 -2.0  -24000.0
  0.0   0.0
  2.0   24000.0
[FY_CURVE]
{ y    fy}
 -2.0  -9000.0
 -1.0  -2000.0
  0.0   0.0
  1.0   2000.0
  2.0   12000.0
[FZ_CURVE]
{ z    fz}
 0.0   0.0
 1.0   800.0
[TX_CURVE]
{ ax   tx}
 -10.0 -20000.0
  10.0  20000.0
[TY_CURVE]
{ ay   ty}
 -10.0 -5000.0
   0.0  0.0
  10.0  8000.0
[TZ_CURVE]
{ az   tz}
 -10.0  0.0
  10.0  0.0
)";

constexpr double kDegree = std::numbers::pi / 180.0;

BusFile bus_of(const std::string& text) {
  return bus_file_from(TeimOrbit::parse(text, "rubber.bus"));
}

std::string changed(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, text.npos) << old;
  return text.replace(at, old.size(), now);
}

std::string complaint_about(const std::string& text) {
  try {
    bus_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(BusFile, AStraightCurveIsAStiffnessInTheUnitsOfTheFile) {
  const BushingParameters bushing = bus_of(kRubber).bushing;
  EXPECT_DOUBLE_EQ(bushing.stiffness.x(), 12e6);  // 24 kN over 2 mm
  EXPECT_DOUBLE_EQ(bushing.stiffness.z(), 0.8e6);
  EXPECT_NEAR(bushing.rotational.x(), 20.0 / (10.0 * kDegree), 1e-10);  // 20 kN mm over 10 degrees
  EXPECT_EQ(bushing.rotational.z(), 0.0);
  EXPECT_DOUBLE_EQ(bushing.damping.x(), 3e3);  // 3 N s/mm
  EXPECT_DOUBLE_EQ(bushing.damping.z(), 1.5e3);
  EXPECT_NEAR(bushing.rotational_damping.x(), 0.1 / kDegree, 1e-12);  // 100 N mm s/degree
}

TEST(BusFile, AnyOtherCurveIsAnElasticPartOfItsAxis) {
  const BushingParameters bushing = bus_of(kRubber).bushing;
  ASSERT_EQ(bushing.parts.size(), 2u);
  EXPECT_EQ(bushing.parts[0].axis, 1);
  EXPECT_EQ(bushing.parts[1].axis, 4);
  EXPECT_EQ(bushing.stiffness.y(), 0.0);
  EXPECT_EQ(bushing.rotational.y(), 0.0);
  const ForceCharacteristic& y = std::get<ElasticCurve>(bushing.parts[0].law).curve;
  ASSERT_EQ(y.points().size(), 5u);
  EXPECT_DOUBLE_EQ(y.points()[0].first, -2e-3);
  EXPECT_DOUBLE_EQ(y.points()[0].second, -9e3);
  const ForceCharacteristic& about_y = std::get<ElasticCurve>(bushing.parts[1].law).curve;
  EXPECT_NEAR(about_y.points()[2].first, 10.0 * kDegree, 1e-15);
  EXPECT_DOUBLE_EQ(about_y.points()[2].second, 8.0);
}

TEST(BusFile, APreloadIsNoStiffness) {
  const BushingParameters bushing =
      bus_of(changed(kRubber, " 0.0   0.0\n 1.0   800.0", " 0.0   50.0\n 1.0   850.0")).bushing;
  ASSERT_EQ(bushing.parts.size(), 3u);
  EXPECT_EQ(std::get<ElasticCurve>(bushing.parts[1].law).curve.at(0.0), 50.0);
}

TEST(BusFile, WhatIsWrittenIsReadBackToTheLastBit) {
  BushingParameters bushing = bus_of(kRubber).bushing;
  bushing.stiffness.x() = 12345678.9;
  bushing.rotational = {1e10, 0.1 + 0.2, 200.0 / 3.0};
  bushing.parts.pop_back();  // the curve about y is straight now
  EXPECT_TRUE(bus_of(bus_text(bushing, "ubj")).bushing == bushing);
  const BushingParameters curved = bus_of(kRubber).bushing;
  EXPECT_TRUE(bus_of(bus_text(curved, "ubj")).bushing == curved);
}

TEST(BusFile, RefusesToWriteWhatItCannotSay) {
  BushingParameters bushing = bus_of(kRubber).bushing;
  const auto said = [&] {
    try {
      bus_text(bushing, "ubj");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(said(), "none");
  bushing.parts.push_back({5, multibody::Friction{1e3, 10.0}});
  EXPECT_NE(said().find("ubj has more than a stiffness or a curve about z"), std::string::npos)
      << said();
  bushing.parts.back() = {1, bushing.parts.front().law};
  EXPECT_NE(said().find("along y"), std::string::npos) << said();
}

TEST(BusFile, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(complaint_about(kRubber), "none");
  for (const auto& [old, now, place, part] : std::vector<std::array<std::string, 4>>{
           {"'bus'", "'tir'", "rubber.bus:3: ", "expected \"bus\""},
           {"'mm'", "'furlong'", "rubber.bus:7: ", "furlong"},
           {"[DAMPING]", "[DAMPINGS]", "rubber.bus: ", "[DAMPING]"},
           {"[TZ_CURVE]", "[TZ_CURV]", "rubber.bus: ", "[TZ_CURVE]"},
           {"[UNITS]", "[UNIT]", "rubber.bus: ", "[UNITS]"},
           {" TX_DAMPING", " DAMPING", "rubber.bus:12: ", "TX_DAMPING"},
           {"FX_DAMPING  =  3.0", "FX_DAMPING  =  -3.0", "rubber.bus:13: ", "not negative"},
           {"  0.0   0.0\n  2.0   24000.0", "  -2.0   0.0\n", "rubber.bus:22: ", "does not rise"},
           {" 1.0   800.0", "", "rubber.bus:31: ", "has 1 row, two"},
           {" 1.0   800.0", " 1.0   -800.0", "rubber.bus:31: ", "[FZ_CURVE] falls"},
           {" 1.0   800.0", " 1.0   8oo", "rubber.bus:34: ", "8oo"},
           {" 1.0   800.0", " 1.0   800.0 1", "rubber.bus:34: ", "3 numbers"},
           {" 1.0   800.0", " 1.0", "rubber.bus:34: ", "2 numbers"}}) {
    const std::string said = complaint_about(changed(kRubber, old, now));
    EXPECT_EQ(said.find(place), 0u) << said;
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
}

/// Returns the file without the lines that contain `part`.
std::string without_lines(const std::string& text, const std::string& part) {
  std::string kept;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string line = text.substr(begin, end - begin);
    if (line.find(part) == std::string::npos) kept += line;
    begin = end;
  }
  return kept;
}

/// Returns the doubts of a file as lines "name: sentence".
std::string doubts_of(const std::string& text) {
  std::string all;
  for (const LedgerDoubt& doubt : bus_of(text).ledger.doubts)
    all += doubt.place.text() + " " + doubt.sentence + "\n";
  return all;
}

TEST(BusFile, AMissingUnitIsRefusedAndTheMessageSaysWhichLineToAdd) {
  for (const auto& [key, line] :
       std::vector<std::array<std::string, 2>>{{" LENGTH", "LENGTH = 'mm'"},
                                               {" ANGLE", "ANGLE = 'degrees'"},
                                               {" FORCE", "FORCE = 'newton'"},
                                               {" TIME", "TIME = 'second'"}}) {
    const std::string said = complaint_about(without_lines(kRubber, key));
    EXPECT_EQ(said.find("rubber.bus:6: [UNITS] has no"), 0u) << said;
    EXPECT_NE(said.find("add the line " + line), std::string::npos) << said;
  }
  EXPECT_EQ(complaint_about(without_lines(kRubber, " MASS")), "none");
  // A damping of 0 is 0 in any unit, so a file without TIME is accepted.
  const std::string undamped =
      changed(changed(changed(kRubber, "_DAMPING  =  3.0", "_DAMPING  =  0"), "=  1.5", "=  0"),
              "=  100.0",
              "=  0");
  EXPECT_EQ(complaint_about(without_lines(undamped, " TIME")), "none");
}

TEST(BusFile, AForceBeforeTheDeflectionIsRefused) {
  const std::string said = complaint_about(changed(kRubber, "{ x    fx}", "{force x}"));
  EXPECT_EQ(said.find("rubber.bus:20: the columns are {FORCE X}"), 0u) << said;
  EXPECT_NE(complaint_about(changed(kRubber, "{ ax   tx}", "{ tx   ax}")).find("{TX AX}"),
            std::string::npos);
}

TEST(BusFile, NamesSectionsAndKeysItLeavesOut) {
  const BusFile file = bus_of(std::string(kRubber) + "[CONSTANTS]\nSCALE = 1\n");
  ASSERT_EQ(file.unused.size(), 1u);
  EXPECT_EQ(file.unused[0].name, "[CONSTANTS]");
  ASSERT_NE(file.ledger.find_written("[CONSTANTS]"), nullptr);
  EXPECT_EQ(file.ledger.find_written("[CONSTANTS]")->state, LedgerState::not_used);
  EXPECT_NE(
      doubts_of(std::string(kRubber) + "[CONSTANTS]\nSCALE = 1\n").find("[CONSTANTS] is not read"),
      std::string::npos);
  const BusFile preloaded =
      bus_of(changed(kRubber, "[DAMPING]\n", "[DAMPING]\nFX_PRELOAD = 200\n"));
  ASSERT_EQ(preloaded.unused.size(), 1u);
  EXPECT_EQ(preloaded.unused[0].name, "[DAMPING] FX_PRELOAD");
  EXPECT_EQ(preloaded.unused[0].line, 13);
  EXPECT_TRUE(bus_of(kRubber).unused.empty());
}

TEST(BusFile, TheLedgerHasARowForEachCurveAndDamping) {
  const Ledger ledger = bus_of(kRubber).ledger;
  EXPECT_EQ(ledger.rows.size(), 5u + 12u);
  EXPECT_EQ(doubts_of(kRubber), "");
  const LedgerRow* about_z = ledger.find_written("[TZ_CURVE]");
  ASSERT_NE(about_z, nullptr);
  EXPECT_EQ(about_z->unit_written, "newton*mm/degrees");
  EXPECT_NEAR(about_z->factor, 1e-3 / kDegree, 1e-15);
}

TEST(BusFile, ADeflectionThatNoBushingReachesIsTold) {
  const std::string meters = doubts_of(changed(kRubber, "'mm'", "'meter'"));
  EXPECT_NE(meters.find("rubber.bus:19 [FX_CURVE] reaches 2 m, which no bushing does: is LENGTH of "
                        "[UNITS] right?"),
            std::string::npos)
      << meters;
  const std::string radians = doubts_of(changed(kRubber, "'degrees'", "'radians'"));
  EXPECT_NE(radians.find("[TX_CURVE] reaches 10 rad, which no bushing does: is ANGLE of [UNITS]"),
            std::string::npos)
      << radians;
}

TEST(BusFile, APreloadAndAFallingPieceOfACurveAreTold) {
  const std::string preload =
      doubts_of(changed(kRubber, " 0.0   0.0\n 1.0   800.0", " 0.0   50.0\n 1.0   850.0"));
  EXPECT_NE(preload.find("rubber.bus:31 [FZ_CURVE] has 50 N at the deflection 0: a preload"),
            std::string::npos)
      << preload;
  const std::string falling = doubts_of(changed(kRubber, " -1.0  -2000.0", " -1.0  2000.0"));
  EXPECT_NE(falling.find("rubber.bus:28 [FY_CURVE] falls from 2000 N to 0 N"), std::string::npos)
      << falling;
}

TEST(BusFile, ASpoiledFileIsABushingWithoutFaultOrAnInputError) {
  constexpr int kFiles = 3000;
  int bushings = 0;
  for (int i = 0; i < kFiles; ++i) {
    RandomStream random(1, i);
    const std::string text = spoiled(
        kRubber, {"[FX_CURVE]\n", "{", "'", "=", "1e309", "-1e308 1e308\n", "NaN", "(A)"}, random);
    try {
      const BushingParameters bushing = bus_of(text).bushing;
      ++bushings;
      EXPECT_TRUE(bushing.stiffness.allFinite() && bushing.rotational.allFinite());
      EXPECT_GE(bushing.damping.minCoeff(), 0.0);
      for (const auto& part : bushing.parts) EXPECT_EQ(multibody::fault_of(part.law), "");
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(bushings, 0);       // some changes leave a valid file
  EXPECT_LT(bushings, kFiles);  // most do
}

}  // namespace
}  // namespace latsch::formats
