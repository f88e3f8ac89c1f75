// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "base/error.h"

namespace latsch::formats {
namespace {

using road::CrgRoad;

const std::filesystem::path kCrgSamples = LATSCH_SOURCE_DIR "/../shared/data/crg";

/// A straight road of 5 x 3 heights z = u²/100 + v/10 on a grid of 1 m x 0.5 m.
const std::string kPlain =
    "$CT\nby hand\n$\n"
    "$ROAD_CRG\nReference_Line_Increment = 1.0 ! m\nlong_section_v_increment = 0.5\n$\n"
    "$KD_Definition\n#:LRFI\nD:long section 1,m\nD:long section 2,m\nD:long section 3,m\n$\n"
    "$$$$$$\n"
    "-0.0500000 0.0000000 0.0500000\n"
    "-0.0400000 0.0100000 0.0600000\n"
    "-0.0100000 0.0400000 0.0900000\n"
    " 0.0400000 0.0900000 0.1400000\n"
    " 0.1100000 0.1600000 0.2100000\n";

std::string with(const std::string& from, const std::string& to, std::string text = kPlain) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}
std::string with_section(const std::string& section) { return with("$KD_", section + "$\n$KD_"); }
CrgRoad road_of(const std::string& text) { return CrgRoad(OpenCrg::parse(text, "road.crg").grid); }
double z(const CrgRoad& road, double u, double v) { return road.elevation({u, v}).value_or(-99.0); }

void expect_crg_message(const std::string& text,
                        const std::string& place,
                        const std::string& words) {
  try {
    OpenCrg::parse(text, "road.crg");
    FAIL() << words;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(place), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  }
}

/// By central differences, away from the lines of the grid; h² times third derivatives and
/// rounding over h are below 1e-8.
void expect_normal_of_surface(const CrgRoad& road, double x, double y) {
  constexpr double h = 1e-5;
  const road::GroundPoint ground = road.at(x, y, 0.0);
  EXPECT_EQ(ground.height, road.height(x, y, 0.0));
  const double dx = (road.height(x + h, y, 0.0) - road.height(x - h, y, 0.0)) / (2 * h);
  const double dy = (road.height(x, y + h, 0.0) - road.height(x, y - h, 0.0)) / (2 * h);
  EXPECT_LT((ground.normal - Eigen::Vector3d(-dx, -dy, 1.0).normalized()).norm(), 1e-8)
      << x << " " << y;
}

TEST(OpenCrg, GridIsBilinearBetweenTheNumbersOfTheFile) {
  const OpenCrg file = OpenCrg::parse(kPlain, "road.crg");
  EXPECT_EQ(file.comment, "by hand\n");
  EXPECT_EQ(file.grid.v, (std::vector<double>{-0.5, 0.0, 0.5}));
  const CrgRoad road(file.grid);
  EXPECT_DOUBLE_EQ(z(road, 2.0, 0.5), 0.09);
  EXPECT_DOUBLE_EQ(z(road, 2.5, 0.25), (0.04 + 0.09) / 2 + 0.025);
  EXPECT_DOUBLE_EQ(road.height(2.5, 0.25, 0.0), z(road, 2.5, 0.25));
  expect_normal_of_surface(road, 2.3, 0.2);
  EXPECT_DOUBLE_EQ(road.height(9.0, 3.0, 0.0), 0.21);  // the edge is kept
}

TEST(OpenCrg, BordersAndSmoothingGoOnAsTheOptionsSay) {
  const auto border = [&](const std::string& options) {
    return road_of(with_section("$ROAD_CRG_OPTS\n" + options));
  };
  EXPECT_FALSE(border("border_mode_u = 0\n").elevation({4.5, 0.0}));
  EXPECT_EQ(border("border_mode_u = 0\n").height(4.5, 0.0, 0.0), 0.16);
  EXPECT_EQ(z(border("border_mode_u = 1\nborder_offset_u = 0.3\n"), 4.5, 0.0), 0.3);
  EXPECT_DOUBLE_EQ(z(border("border_mode_v = 2\nborder_offset_v = 0.3\n"), 2.0, 0.7), 0.39);
  const CrgRoad repeat = border("border_mode_u = 3\nborder_mode_v = 3\n");
  EXPECT_DOUBLE_EQ(z(repeat, 6.5, 0.25 + 2.0), z(repeat, 2.5, 0.25));
  EXPECT_DOUBLE_EQ(z(repeat, -1.5, -0.75), z(repeat, 2.5, 0.25));
  const CrgRoad reflect = border("border_mode_u = 4\nborder_mode_v = 4\n");
  EXPECT_DOUBLE_EQ(z(reflect, -1.5, 0.75), z(reflect, 1.5, 0.25));
  EXPECT_DOUBLE_EQ(z(reflect, 5.5, -0.75), z(reflect, 2.5, -0.25));
  expect_normal_of_surface(reflect, -1.4, 0.7);
  const CrgRoad smooth = border("border_smooth_ubeg = 2\nborder_smooth_uend = 1\n");
  EXPECT_DOUBLE_EQ(z(smooth, 1.0, 0.25), 0.5 * (0.01 + 0.025));
  EXPECT_DOUBLE_EQ(z(smooth, 4.0, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(z(smooth, -1.0, 0.5), 0.0);
  expect_normal_of_surface(smooth, 1.3, 0.2);
  expect_normal_of_surface(smooth, 3.6, -0.3);
}

TEST(OpenCrg, ModifiersScaleAndMoveTheRoad) {
  const auto changed = [&](const std::string& modifiers) {
    return road_of(with_section("$ROAD_CRG_MODS\n" + modifiers));
  };
  EXPECT_DOUBLE_EQ(z(changed("scale_z_grid = 2\n"), 2.0, 0.5), 0.18);
  EXPECT_DOUBLE_EQ(z(changed("scale_width = 4\n"), 2.0, 2.0), 0.09);
  EXPECT_DOUBLE_EQ(z(changed("scale_length = 10\n"), 20.0, 0.5), 0.09);
  const double quarter = std::acos(0.0);
  const CrgRoad turned = changed(
      "refline_offset_phi = 1.5707963267948966\n"
      "refline_offset_x = 7\nrefline_offset_z = 1\n");
  EXPECT_NEAR(turned.height(7.0 - 0.5, 2.0, 0.0), 1.09, 1e-15);
  expect_normal_of_surface(turned, 6.8, 2.3);
  const CrgRoad placed = changed(
      "refpoint_u_fraction = 0.5\nrefpoint_v = 0.5\nrefpoint_x = 100\n"
      "refpoint_y = 50\nrefpoint_z = -3\nrefpoint_phi = 1.5707963267948966\n");
  EXPECT_NEAR(placed.height(100.0, 50.0, 0.0), -3.0, 1e-14);
  EXPECT_NEAR(placed.height(100.0, 51.0, 0.0), -3.0 + 0.05, 1e-14);
  EXPECT_NEAR(placed.point({2.0, 0.0}).x(), 100.0 + 0.5, 1e-13);
  EXPECT_NEAR(quarter, 1.5707963267948966, 1e-16);
}

TEST(OpenCrg, GapsAreFilledFromTheSideOrStayAsAsked) {
  const std::string gap = with("-0.0100000 0.0400000 0.0900000", "-0.0100000*missing*          ");
  EXPECT_EQ(OpenCrg::parse(gap, "road.crg").gaps, 2);
  EXPECT_EQ(z(road_of(gap), 2.0, 0.5), -0.01);
  const auto mode = [&](const std::string& modifiers) {
    return road_of(with("$KD_", "$ROAD_CRG_MODS\n" + modifiers + "$\n$KD_", gap));
  };
  EXPECT_EQ(z(mode("grid_nan_mode = 1\ngrid_nan_offset = 0.2\n"), 2.0, 0.5), 0.2);
  EXPECT_DOUBLE_EQ(z(mode("grid_nan_mode = 2\ngrid_nan_offset = 0.2\n"), 2.0, 0.0), 0.19);
  EXPECT_FALSE(mode("grid_nan_mode = 0\n").elevation({2.0, 0.5}));
  EXPECT_EQ(mode("grid_nan_mode = 0\n").height(2.0, 0.5, 0.0), -0.01);
}

TEST(OpenCrg, ReadsEveryFormatOfNumbers) {
  const auto big_endian = [](double value, bool wide) {
    std::uint64_t bits = 0;
    const float narrow = static_cast<float>(value);
    if (wide) {
      std::memcpy(&bits, &value, 8);
    } else {
      std::uint32_t half = 0;
      std::memcpy(&half, &narrow, 4);
      bits = half;
    }
    std::string bytes;
    for (int shift = wide ? 56 : 24; shift >= 0; shift -= 8)
      bytes += static_cast<char>(bits >> shift);
    return bytes;
  };
  const CrgRoad expected = road_of(kPlain);
  const std::string head = with("#:LRFI", "#:....").substr(0, kPlain.find("$$$$$$"));
  for (const std::string format : {"KRBI", "LRBI", "KDBI", "LDBI", "LDFI", "KRFI", "KDFI"}) {
    std::string data;
    for (int u = 0; u < 5; ++u) {
      std::string record;
      for (const double v : {-0.5, 0.0, 0.5}) {
        const double value = u * u / 100.0 + v / 10.0;
        char digits[32];
        std::snprintf(digits, sizeof digits, format[1] == 'D' ? "%20.12e" : "%10.7f", value);
        record += format[2] == 'F' ? digits : big_endian(value, format[1] == 'D');
      }
      if (format[0] == 'L' && format[2] == 'B') record.resize(80, '\0');
      data += record;
      if (format[0] == 'L' && format[2] == 'F') data += "\r\n";
    }
    const CrgRoad road = road_of(with("....", format, head) + "$$$$\n" + data);
    // 4 bytes carry 24 bits of mantissa, the shorter texts seven decimals.
    const double tolerance = format[1] == 'D' ? 1e-13 : 1e-8;
    for (double u = 0.1; u < 4.0; u += 0.37) {
      EXPECT_NEAR(z(road, u, 0.3), z(expected, u, 0.3), tolerance) << format;
    }
  }
}

TEST(OpenCrg, ArcIsAnArcAndItsNormalsAreThoseOfTheSurface) {
  // 100 steps of 0.5 m along a circle of 30 m: chords of heading (i - 1/2) step / radius.
  std::string text = with("= 1.0 !", "= 0.5 !").substr(0, kPlain.find("$$$$$$") + 0);
  text = with("D:long section 1", "D:reference line phi,rad\nD:long section 1", text) + "$$$$\n";
  constexpr double kRadius = 30.0, kStep = 0.5;
  for (int i = 0; i <= 100; ++i) {
    char line[64];
    std::snprintf(line,
                  sizeof line,
                  "%10.7f%10.5f%10.5f%10.5f\n",
                  (i - 0.5) * kStep / kRadius,
                  std::sin(0.3 * i),
                  std::cos(0.2 * i),
                  std::sin(0.5 * i));
    text += line;
  }
  const CrgRoad road = road_of(text);
  for (double u = 0.3; u < 50.0; u += 1.7) {
    for (const double v : {-0.4, 0.1, 0.45}) {
      const Eigen::Vector2d place = road.point({u, v});
      // The sum of chords is an arc of its circumscribed polygon: sagitta and angle of a step.
      const double r = (place - Eigen::Vector2d(0.0, kRadius)).norm();
      EXPECT_NEAR(r, kRadius - v, kStep * kStep / (4 * kRadius)) << u;
      const auto back = road.locate(place.x(), place.y());
      EXPECT_NEAR(back.u, u, 1e-12 * 50);
      EXPECT_NEAR(back.v, v, 1e-13 * 50);
      expect_normal_of_surface(road, place.x() + 0.01, place.y());
    }
  }
}

TEST(OpenCrg, EveryPlaceHasAHeightAndANormalAlsoInsideATightBend) {
  // Headings that turn by a radian a meter: the center lies at a meter, well within the places
  // asked.
  std::string text = with("D:long section 1", "D:reference line phi,rad\nD:long section 1");
  text = text.substr(0, text.find("$$$$$$")) + "$$$$\n";
  for (int i = 0; i < 7; ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "%10.5f%10.5f%10.5f%10.5f\n", double(i), 0.1 * i, 0.2, 0.3);
    text += line;
  }
  const CrgRoad road = road_of(text);
  for (double x = -3.0; x <= 3.0; x += 0.05) {
    for (double y = -3.0; y <= 3.0; y += 0.05) {
      const road::GroundPoint ground = road.at(x, y, 0.0);
      ASSERT_TRUE(std::isfinite(ground.height) && ground.normal.allFinite()) << x << " " << y;
      ASSERT_LE(std::abs(ground.height), 0.7);
    }
  }
}

TEST(OpenCrg, ReferenceLineWithAnEndMeetsIt) {
  std::string text = with("$ROAD_CRG\n",
                          "$ROAD_CRG\nreference_line_end_x = 3.9\nreference_line_end_y = 0.1\n"
                          "reference_line_start_z = 1\nreference_line_end_z = 1.5\n");
  text = with("D:long section 1",
              "D:reference line phi,rad\nD:reference line slope,m/m\nD:long section 1",
              text);
  text = text.substr(0, text.find("$$$$$$")) + "$$$$\n";
  for (int i = 0; i < 5; ++i) text += " 0.0000000 0.1000000 0.0000000 0.0000000 0.0000000\n";
  const OpenCrg file = OpenCrg::parse(text, "road.crg");
  EXPECT_NEAR(file.grid.line.back().x(), 3.9, 1e-15);
  EXPECT_NEAR(file.grid.line.back().y(), 0.1, 1e-15);
  EXPECT_EQ(file.grid.line.front().x(), 0.0);
  EXPECT_DOUBLE_EQ(file.grid.line_height.front(), 1.0);
  EXPECT_DOUBLE_EQ(file.grid.line_height.back(), 1.5);
}

TEST(OpenCrg, ClosedTrackComesRound) {
  std::string text = with("$KD_", "$ROAD_CRG_OPTS\nrefline_continuation = 1\n$\n$KD_");
  text = with("D:long section 1", "D:reference line phi,rad\nD:long section 1", text);
  text = with("= 1.0 !", "= 1.0471975512 !", text);  // a sixtieth of a circle of 10 m
  text = text.substr(0, text.find("$$$$$$")) + "$$$$\n";
  for (int i = 0; i < 60; ++i) {  // one step is open
    char line[64];
    std::snprintf(line,
                  sizeof line,
                  "%10.7f%10.5f%10.5f%10.5f\n",
                  (i - 0.5) * std::acos(-1.0) / 30.0,
                  0.1,
                  0.1,
                  0.1);
    text += line;
  }
  const CrgRoad road = road_of(text);
  EXPECT_NEAR(road.height(0.0, 0.0, 0.0), 0.1, 1e-15);
  const auto once = road.locate(-0.3, 0.0), twice = road.locate(-0.7, 0.0);
  EXPECT_LT(std::abs(once.u), 1.0);
  EXPECT_GT(twice.u, 60.0);  // nearer to the end
}

TEST(OpenCrg, SaysWhereAndWhatIsWrong) {
  expect_crg_message("", "road.crg: ", "no data");
  expect_crg_message(with("$$$$$$\n", "$\n"), "road.crg:15: ", "expected a section");
  expect_crg_message(with("Reference_Line_Increment", "reference_line_incremnet"),
                     "road.crg:5: ",
                     "did you mean \"reference_line_increment\"");
  expect_crg_message(with("= 1.0 !", "= fast !"), "road.crg:5: ", "expected a number");
  expect_crg_message(with("#:LRFI", "#:LXFI"), "road.crg:9: ", "expected one such as");
  expect_crg_message(with("#:LRFI\n", ""), "road.crg:13: ", "no format");
  expect_crg_message(with("section 2,m", "section 2,ft"), "road.crg:11: ", "expected \"m\"");
  expect_crg_message(with("section 2,m", "section 3,m"), "road.crg:", "section 2");
  expect_crg_message(with("D:long section 2,m", "D:surface,m"), "road.crg:11: ", "expected \"long");
  expect_crg_message(
      with("0.0100000 0.0600000", "0.01x0000 0.0600000"), "road.crg:16: ", "0.01x0000");
  expect_crg_message(with("0.0100000 0.0600000", "0.0100000"), "road.crg:16: ", "expected 3");
  expect_crg_message(with("$ROAD_CRG\n", "$ROAD_CRG\nreference_line_end_u = 9\n"),
                     "road.crg: ",
                     "5 records, expected 10");
  expect_crg_message(with("$ROAD_CRG\n", "$ROAD_CRG\nreference_line_end_u = 1e30\n"),
                     "road.crg:5: ",
                     "expected 2 to 1e8");
  expect_crg_message(
      with_section("$ROAD_CRG_OPTS\nborder_mode_u = 7\n"), "road.crg:9: ", "0, 1, 2, 3 or 4");
  expect_crg_message(with_section("$ROAD_CRG_FILE\n other.crg\n"), "road.crg:9: ", "other.crg");
  expect_crg_message(with_section("$ROAD_CGR\n"), "road.crg:8: ", "did you mean \"$road_crg\"");
}

// A sample of the standard states LOG_EVAL twice.
TEST(OpenCrg, OfAnOptionThatComesTwiceTheLastOneCountsWithAWarning) {
  const OpenCrg file = OpenCrg::parse(
      with_section("$ROAD_CRG_OPTS\nLOG_EVAL = 1\nLOG_EVAL_FREQ = 10\nlog_eval = 0\n$\n"
                   "$ROAD_CRG_MODS\nSCALE_Z_GRID = 3\nscale_z_grid = 2\n"),
      "road.crg");
  EXPECT_DOUBLE_EQ(z(CrgRoad(file.grid), 2.0, 0.5), 0.18);
  EXPECT_EQ(file.warnings,
            (std::vector<std::string>{
                "road.crg:11: log_eval comes a second time: 0 counts, 1 of line 9 does not",
                "road.crg:15: scale_z_grid comes a second time: 2 counts, 3 of line 14 does not"}));
  EXPECT_TRUE(OpenCrg::parse(kPlain, "road.crg").warnings.empty());
  // Of the surface itself two statements contradict each other.
  expect_crg_message(with("$ROAD_CRG\n", "$ROAD_CRG\nreference_line_increment = 2\n"),
                     "road.crg:6: ",
                     "comes twice");
}

TEST(OpenCrg, FollowsAFileFromTheFolderOfTheOneThatNamesIt) {
  const auto folder = std::filesystem::temp_directory_path() / ("crg" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "data.crg") << kPlain;
  std::ofstream(folder / "file.crg") << "$CT\n$\n$ROAD_CRG_FILE\n data.crg ! here\n$\n"
                                        "$ROAD_CRG_MODS\nscale_z_grid = 3\n$\n";
  std::ofstream(folder / "self.crg") << "$ROAD_CRG_FILE\n self.crg\n$\n";
  EXPECT_DOUBLE_EQ(z(CrgRoad(OpenCrg::read(folder / "file.crg").grid), 2.0, 0.5), 0.27);
  std::ofstream(folder / "twice.crg") << "$ROAD_CRG_OPTS\nlog_eval = 1\nlog_eval = 1\n$\n"
                                         "$ROAD_CRG_FILE\n data.crg\n$\n";
  EXPECT_EQ(OpenCrg::read(folder / "twice.crg").warnings.size(), 1u);
  EXPECT_THROW(OpenCrg::read(folder / "self.crg"), InputError);
  std::filesystem::remove_all(folder);
}

struct Reference {
  double x, y, u, v, z;
};

// Numbers by an independent program: the C library of OpenCRG 1.2.0, no modifiers applied, options
// at their defaults. It keeps heights in single precision.
void expect_as(const char* name, const std::vector<Reference>& points) {
  const CrgRoad road(OpenCrg::read(kCrgSamples / name).grid);
  for (const Reference& point : points) {
    const auto place = road.locate(point.x, point.y);
    EXPECT_NEAR(place.u, point.u, 1e-10) << name << " " << point.x;
    EXPECT_NEAR(place.v, point.v, 1e-10) << name << " " << point.x;
    EXPECT_NEAR(road.height(point.x, point.y, 0.0), point.z, 1e-7) << name << " " << point.x;
  }
}

TEST(OpenCrg, SamplesHaveTheHeightsOfTheLibraryOfTheStandard) {
  if (!std::filesystem::exists(kCrgSamples)) GTEST_SKIP() << "no samples in " << kCrgSamples;
  expect_as("handmade_curved_banked_sloped.crg",
            {{3.3, 0.4, 3.3115078613, 0.356893998409, 0.0634654557},
             {10.2, 1.1, 10.2800970146, 0.577942289677, 0.602406927},
             {20.5, 3, 20.5650015521, 1.7962209283, 1.22889249},
             {8.5, -1.2, 8.37609028056, -1.54667896588, 0.230501555},
             {-1, 0.3, -1, 0.3, 0},
             {25, 6, 25.0465541014, 4.79134149907, 1.21},
             {15.7, 3.3, 15.8830360019, 2.26831387707, 1.11468848}});
  expect_as("handmade_curved_minimalist.crg",
            {{3.3, 0.4, 3.3115078613, 0.356893998409, 0.0111111002},
             {10.2, 1.1, 10.2800970146, 0.577942289677, 0.0175992896},
             {8.5, -1.2, 8.37609028056, -1.54667896588, 0.0111111002},
             {25, 6, 25.0465541014, 4.79134149907, 0},
             {15.7, 3.3, 15.8830360019, 2.26831387707, -0.0235217992}});
  expect_as("handmade_straight.crg",
            {{3.3, 0.4, 3.3, 0.4, 0.0111111002},
             {10.2, 1.1, 10.2, 1.1, 0.00177777603},
             {-1, 0.3, -1, 0.3, 0},
             {15.7, 3.3, 15.7, 3.3, -0.0255555307}});
  expect_as("halfround_4in.crg", {{49.95, 0, 49.95, 0, 0}, {50.02, -2, 50.02, -2, 0.0605309829}});
}

TEST(OpenCrg, TheMinimalistSampleIsTheStraightOneAsItSays) {
  if (!std::filesystem::exists(kCrgSamples)) GTEST_SKIP() << "no samples in " << kCrgSamples;
  const OpenCrg a = OpenCrg::read(kCrgSamples / "handmade_straight.crg");
  const OpenCrg b = OpenCrg::read(kCrgSamples / "handmade_straight_minimalist.crg");
  EXPECT_EQ(a.grid.v, b.grid.v);
  EXPECT_EQ(a.grid.z, b.grid.z);
  EXPECT_GT(a.gaps, 0);
}

}  // namespace
}  // namespace latsch::formats
