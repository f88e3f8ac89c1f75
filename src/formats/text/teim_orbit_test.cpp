// SPDX-License-Identifier: Apache-2.0
#include "formats/text/teim_orbit.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "base/spoiled_text_testing.h"

namespace latsch::formats {
namespace {

const std::string kFile =
    "$ r\xE4 in Latin-1\r\n"
    "[MDI_HEADER]\r\n"
    "FILE_TYPE = 'tir'\r\n"
    "(COMMENTS)\r\n"
    "{comment_string}\r\n"
    "'costs 5 $ ! = much'\r\n"
    "[units]\r\n"
    " length='mm'  $the rest in SI\r\n"
    " ANGLE = 'degrees'\r\n"
    "! a comment\r\n"
    "[VERTICAL]\r\n"
    "FNOMIN = 1.5D+3      $Nominal load\r\n"
    "[DEFLECTION_LOAD_CURVE]\r\n"
    "{pen fz}\r\n"
    " 0.0   0.0\r\n"
    " 1.0,  200  $ more\r\n"
    "[DEFLECTION_LOAD_CURVE]\r\n"
    "0 1\r\n";

TeimOrbit parsed_orbit(const std::string& text) { return TeimOrbit::parse(text, "t.tir"); }

std::string orbit_complaint(
    const std::string& text,
    const std::function<void(const TeimOrbit&)>& read = [](const TeimOrbit&) {}) {
  try {
    read(parsed_orbit(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TeimOrbit, SectionsKeysTextsAndComments) {
  const TeimOrbit file = parsed_orbit(kFile);
  ASSERT_EQ(file.sections().size(), 5u);
  EXPECT_EQ(file.section("mdi_header").text("file_type"), "tir");
  EXPECT_EQ(file.section("VERTICAL").number("fnomin"), 1500.0);
  EXPECT_EQ(file.section("VERTICAL").find("FNOMIN")->comment, "Nominal load");
  EXPECT_EQ(file.section("VERTICAL").find("FNOMIN")->line, 12);
  EXPECT_EQ(file.section("VERTICAL").number("BREFF", 8.4), 8.4);
  EXPECT_EQ(file.find("SHAPE"), nullptr);
}

TEST(TeimOrbit, TablesWithAndWithoutHeadsAndSubBlocks) {
  const TeimOrbit file = parsed_orbit(kFile);
  const TeimOrbitTable* words = file.section("MDI_HEADER").find_table("comments");
  ASSERT_NE(words, nullptr);
  EXPECT_EQ(words->rows.at(0).fields, (std::vector<std::string>{"costs 5 $ ! = much"}));
  const TeimOrbitSection& curve = file.section("DEFLECTION_LOAD_CURVE");
  const TeimOrbitTable* table = curve.find_table("");
  EXPECT_EQ(table->heads, (std::vector<std::string>{"PEN", "FZ"}));
  EXPECT_EQ(curve.numbers(table->rows.at(1), 2), (std::vector<double>{1.0, 200.0}));
  EXPECT_EQ(file.sections().back().tables().at(0).rows.size(), 1u);
}

TEST(TeimOrbit, UnitsInSi) {
  const TeimOrbitUnits units = parsed_orbit(kFile).units(TeimOrbitUnits::Missing::is_si);
  EXPECT_EQ(units.length(), 1e-3);
  EXPECT_EQ(units.angle(), std::numbers::pi / 180.0);
  EXPECT_EQ(units.force(), 1.0);
  EXPECT_NEAR(units.pressure(), 1e6, 1e-9);  // N/mm^2, because the file states no unit of pressure
  EXPECT_EQ(parsed_orbit("[UNITS]\nPRESSURE='bar'\n").units().pressure(), 1e5);
}

TEST(TeimOrbit, AUnitThatTheFileDoesNotStateIsRefusedAtItsFirstUse) {
  const auto uses_length = [](const TeimOrbit& file) { file.units().length(); };
  const auto uses_pressure = [](const TeimOrbit& file) { file.units().pressure(); };
  const std::string none = orbit_complaint("[MODEL]\n", uses_length);
  EXPECT_EQ(none.find("t.tir: there is no section [UNITS]"), 0u) << none;
  EXPECT_NE(none.find("LENGTH = 'mm' below a line [UNITS]"), std::string::npos) << none;
  EXPECT_NE(none.find("FORCE, ANGLE, MASS, TIME are missing, too"), std::string::npos) << none;
  const std::string one =
      orbit_complaint("[A]\n[UNITS]\nFORCE='newton'\nANGLE='deg'\nMASS='kg'\n", uses_length);
  EXPECT_EQ(one.find("t.tir:2: [UNITS] has no LENGTH"), 0u) << one;
  EXPECT_NE(one.find("TIME is missing, too"), std::string::npos) << one;
  EXPECT_EQ(orbit_complaint("[UNITS]\nLENGTH='mm'\n", uses_length), "");
  EXPECT_NE(orbit_complaint("[UNITS]\nLENGTH='mm'\n", uses_pressure).find("has no FORCE"),
            std::string::npos);
  const TeimOrbitUnits si =
      parsed_orbit("[UNITS]\nLENGTH='mm'\nMASS='kg'\n").units(TeimOrbitUnits::Missing::is_si);
  EXPECT_EQ(si.angle(), 1.0);
  EXPECT_EQ(si.missing(), (std::vector<std::string>{"FORCE", "ANGLE", "TIME"}));
  EXPECT_EQ(TeimOrbitUnits::si_in_words("ANGLE"), "radian");
}

TEST(TeimOrbit, ASecondSectionOfANameIsAnUnreadPart) {
  const TeimOrbit file = parsed_orbit("[A]\nX = 1\n[A]\nX = 2\n[B]\nY = 1\nZ = 2\n");
  EXPECT_EQ(file.section("A").number("X"), 1.0);
  EXPECT_EQ(file.section("B").number("Y"), 1.0);
  const std::vector<TeimOrbitPart> unread = file.unread();
  ASSERT_EQ(unread.size(), 2u);
  EXPECT_EQ(unread[0].name, "a second [A]");
  EXPECT_EQ(unread[0].line, 3);
  EXPECT_EQ(unread[1].name, "[B] Z");
  EXPECT_EQ(unread[1].line, 7);
}

TEST(TeimOrbit, ReplacedValuesLeaveEveryOtherByte) {
  const TeimOrbit file = parsed_orbit(kFile);
  EXPECT_EQ(file.with_values({}), kFile);
  std::string changed = kFile;
  changed.replace(changed.find("1.5D+3"), 6, "1600");
  EXPECT_EQ(file.with_values({{file.section("VERTICAL").find("FNOMIN"), "1600"}}), changed);
}

TEST(TeimOrbit, ComplaintsNameFileLineAndWhatWasExpected) {
  EXPECT_EQ(orbit_complaint("[A]\nB = 'x\n"), "t.tir:2: a quote is not closed: \"B = 'x\"");
  EXPECT_EQ(orbit_complaint("[A\n"), "t.tir:1: \"[A\" has no \"]\"");
  EXPECT_EQ(orbit_complaint("A = 1\n"),
            "t.tir:1: this precedes the first [SECTION]: is it a file of another kind?");
  EXPECT_EQ(orbit_complaint("[A]\nFNOMIN 3\n"),
            "t.tir:2: \"FNOMIN 3\" is no KEY = value, [SECTION], {heads} or row of a table");
  const auto fnomin = [](const TeimOrbit& file) { file.section("A").number("FNOMIN"); };
  EXPECT_EQ(
      orbit_complaint("[A]\n\nFNOMIN = 3,5\n", fnomin),
      "t.tir:3: FNOMIN is \"3,5\", expected a finite number; decimals are written with a point");
  EXPECT_EQ(orbit_complaint("[A]\nFNOMIN = 260,000\n", fnomin),
            "t.tir:2: FNOMIN is \"260,000\", expected a finite number; decimals are written with a "
            "point, and thousands without a mark: 260000 if the comma separates thousands");
  EXPECT_EQ(orbit_complaint("[A]\nFNOMIN = nan\n", fnomin),
            "t.tir:2: FNOMIN is \"nan\", expected a finite number");
  EXPECT_EQ(orbit_complaint("[A]\nB = 2\n", fnomin), "t.tir:1: [A] has no FNOMIN");
  EXPECT_EQ(orbit_complaint("[A]\nFNOMIN = 2\nfnomin = 3\n", fnomin),
            "t.tir:3: FNOMIN is \"3\", but line 2 says \"2\"; keep one of them");
  EXPECT_NE(orbit_complaint("[UNITS]\nLENGTH='furlong'\n", [](const TeimOrbit& f) { f.units(); })
                .find("t.tir:2: LENGTH = \"furlong\" is refused: unknown unit"),
            std::string::npos);
  EXPECT_EQ(orbit_complaint(std::string("[A]\nB\0 = 2\n", 11)),
            "t.tir:2: a zero byte: this is not a text file");
}

TEST(TeimOrbit, SpoiledFilesEndInAFileOrAComplaint) {
  int good = 0;
  for (int i = 0; i < 3000; ++i) {
    RandomStream random(4, i);
    const std::string text = spoiled(kFile, {"[", "{", "(", "'", "=", "1e309", "$"}, random);
    good += orbit_complaint(text, [](const TeimOrbit& file) {
              file.units();
              for (const TeimOrbitSection& section : file.sections())
                for (const TeimOrbitTable& table : section.tables())
                  for (const TeimOrbitRow& row : table.rows) section.numbers(row, 2);
            }).empty();
  }
  EXPECT_LT(good, 3000);
}

}  // namespace
}  // namespace latsch::formats
