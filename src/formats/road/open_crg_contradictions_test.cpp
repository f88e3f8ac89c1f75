// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "formats/road/open_crg.h"

namespace latsch::formats {
namespace {

const std::filesystem::path kSamples = LATSCH_SOURCE_DIR "/../shared/data/crg";

/// Returns the text of a flat road with five rows, 1 m apart, and long sections at v = -1, 0 and
/// 1 m. `statements` are those of $ROAD_CRG. `channels` defines channels of the reference line, and
/// `values` contains their values in each row. The sections are defined by their positions if
/// `by_place` is true, otherwise by their numbers.
std::string crg(const std::string& statements,
                const std::string& channels = "",
                const std::vector<std::string>& values = {"", "", "", "", ""},
                bool by_place = true) {
  std::string text = "$ROAD_CRG\n" + statements + "$\n$KD_Definition\n#:LRFI\n" + channels;
  for (const char* place : {"-1", "0", "1"})
    text += by_place
                ? std::string("D:long section at v = ") + place + ",m\n"
                : std::string("D:long section ") + std::to_string(std::stoi(place) + 2) + ",m\n";
  text += "$\n$$$$\n";
  for (const std::string& line : values) text += line + " 0.0000000 0.0000000 0.0000000\n";
  return text;
}

std::vector<std::string> said(const std::string& text) {
  return OpenCrg::parse(text, "road.crg").warnings;
}

void expect_one(const std::string& text, const std::string& words) {
  const auto warnings = said(text);
  ASSERT_EQ(warnings.size(), 1u) << words << (warnings.empty() ? "" : ": " + warnings[0]);
  EXPECT_NE(warnings[0].find(words), std::string::npos) << warnings[0];
  EXPECT_EQ(warnings[0].find("road.crg:"), 0u) << warnings[0];
}

const std::string kRows = "reference_line_increment = 1\n";

TEST(OpenCrgContradictions, ConsistentHeadersAndTheSamplesOfTheStandardHaveNone) {
  EXPECT_TRUE(said(crg(kRows + "long_section_v_right = -1\nlong_section_v_left = 1\n"
                               "long_section_v_increment = 1\nreference_line_end_u = 4\n"
                               "reference_line_end_x = 4\nreference_line_end_y = 0\n"
                               "reference_line_end_z = 0\n"))
                  .empty());
  if (!std::filesystem::exists(kSamples)) GTEST_SKIP() << "no ../shared/data/crg";
  for (const auto& entry : std::filesystem::directory_iterator(kSamples))
    if (entry.path().extension() == ".crg") {
      const auto warnings = OpenCrg::read(entry.path()).warnings;
      EXPECT_TRUE(warnings.empty()) << entry.path() << ": " << warnings[0];
    }
}

TEST(OpenCrgContradictions, StatedBordersAreComparedWithThePositionsOfTheSections) {
  expect_one(crg(kRows + "long_section_v_left = 15\n"),
             "road.crg:3: long_section_v_left is 15, but it is 1 by the positions of the long "
             "sections, which counts");
  EXPECT_EQ(said(crg(kRows + "long_section_v_right = 1\nlong_section_v_left = -1\n")).size(), 2u);
  expect_one(crg(kRows + "long_section_v_increment = 0.5\n"),
             "long_section_v_increment is 0.5, but it is 1");
}

TEST(OpenCrgContradictions, StatedBordersAreComparedWithTheIncrementOfNumberedSections) {
  const std::vector<std::string> rows(5);
  expect_one(crg(kRows + "long_section_v_right = -1\nlong_section_v_left = 3\n"
                         "long_section_v_increment = 1\n",
                 "",
                 rows,
                 false),
             "long_section_v_left is 3, but it is 1 by long_section_v_right");
  EXPECT_TRUE(
      said(crg(kRows + "long_section_v_right = -1\nlong_section_v_left = 3\n", "", rows, false))
          .empty());
}

TEST(OpenCrgContradictions, RowsAreComparedWithTheirChannels) {
  const std::vector<std::string> u = {
      "0.0000000", "1.0000000", "2.0000000", "3.0000000", "4.0000000"};
  const std::string channel = "D:reference line u,m\n";
  EXPECT_TRUE(said(crg(kRows, channel, u)).empty());
  expect_one(crg("reference_line_increment = 0.5\n", channel, u),
             "reference_line_increment is 0.5, but it is 1 by channel u");
  expect_one(crg(kRows + "reference_line_start_u = 7\n", channel, u),
             "reference_line_start_u is 7, but it is 0 by channel u");
  expect_one(crg(kRows, "U:reference line u,m,0,2.0\n"), "the virtual channel u begins at 0");
  EXPECT_TRUE(said(crg(kRows, "U:reference line u,m,0,1.0\n")).empty());
}

TEST(OpenCrgContradictions, PointsAndHeadingsAreComparedWithStartAndEnd) {
  const std::vector<std::string> xy = {"0.0000000 5.0000000",
                                       "1.0000000 5.0000000",
                                       "2.0000000 5.0000000",
                                       "3.0000000 5.0000000",
                                       "4.0000000 5.0000000"};
  const std::string channels = "D:reference line x,m\nD:reference line y,m\n";
  EXPECT_TRUE(said(crg(kRows, channels, xy)).empty());
  expect_one(crg(kRows + "reference_line_start_y = 50\n", channels, xy),
             "reference_line_start_y is 50, but it is 5 by channel y");
  expect_one(crg(kRows + "reference_line_start_phi = 1.5708\n", channels, xy),
             "reference_line_start_phi is 1.5708, but it is 0 by channels x and y");
  // The stated end of a straight line disagrees with its start, heading and length.
  expect_one(crg(kRows + "reference_line_start_phi = 0\nreference_line_end_x = 40\n"
                         "reference_line_end_y = 0\n"),
             "reference_line_end_x is 40, but it is 4 by start, heading and length");
}

TEST(OpenCrgContradictions, HeightsAndBankingAreComparedWithTheirChannels) {
  expect_one(crg(kRows + "reference_line_end_z = 2\n"),
             "reference_line_end_z is 2, but it is 0 by its start and a slope of 0");
  expect_one(crg(kRows + "reference_line_start_s = 0.1\nreference_line_end_z = 3\n"),
             "reference_line_end_z is 3, but the slope leads to 0.4 m");
  const std::vector<std::string> bank(5, "0.0500000");
  expect_one(
      crg(kRows + "reference_line_start_b = -0.05\n", "D:reference line banking,m/m\n", bank),
      "reference_line_start_b is -0.05, but it is 0.05 by channel banking");
}

TEST(OpenCrgContradictions, DegreesAndPerCentAreDoubted) {
  expect_one(crg(kRows + "reference_line_start_phi = 90\n"),
             "reference_line_start_phi is 90 rad, 14.3 turns: is it in degrees?");
  expect_one(crg(kRows + "reference_line_start_s = 5\n"),
             "reference_line_start_s is 5 m/m, steeper than 45 deg");
  expect_one(crg(kRows + "reference_line_start_b = 3\n"), "reference_line_start_b is 3 m/m");
  expect_one(crg(kRows + "reference_line_start_lat = 148\n"), "which no place on the globe has");
  const std::vector<std::string> slope(5, "2.5000000");
  expect_one(crg(kRows, "D:reference line slope,m/m\n", slope), "channel slope goes up to 2.5 m/m");
  EXPECT_TRUE(said(crg(kRows + "reference_line_start_phi = 1.5708\nreference_line_start_s = 0.1\n"))
                  .empty());
}

TEST(OpenCrgContradictions, ModifiersAreNoContradictions) {
  const std::string wide = crg(kRows + "long_section_v_right = -1\nlong_section_v_left = 1\n");
  const std::string scaled = wide.substr(0, wide.find("$KD_")) +
                             "$ROAD_CRG_MODS\nscale_width = 2\nrefline_offset_x = 9\n$\n" +
                             wide.substr(wide.find("$KD_"));
  EXPECT_TRUE(said(scaled).empty());
}

// One degree of latitude is 111.195 km on a sphere of radius 6371 km.
TEST(OpenCrgContradictions, StartAndEndOnTheGlobeAreAtMostTheLengthOfTheLineApart) {
  const auto globe = [](const std::string& end_lat, const std::string& end_lon) {
    return crg(kRows + "reference_line_start_lat = 48\nreference_line_start_lon = 11\n" +
               "reference_line_end_lat = " + end_lat + "\nreference_line_end_lon = " + end_lon +
               "\n");
  };
  EXPECT_TRUE(said(globe("48.00003", "11")).empty());
  expect_one(globe("49", "11"), "1.112e+05 m apart by latitude and longitude");
  expect_one(globe("48", "12"), "the line is 4 m long");
}

}  // namespace
}  // namespace latsch::formats
