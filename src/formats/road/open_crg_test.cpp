// SPDX-License-Identifier: Apache-2.0
#include "formats/road/open_crg.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "formats/road/road_file.h"

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

/// Compares the normal with central differences at a point that is not on a grid line. The errors
/// of the differences, h² times third derivatives and rounding divided by h, are below 1e-8.
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
  // outside of the grid the height at its edge continues
  EXPECT_DOUBLE_EQ(road.height(9.0, 3.0, 0.0), 0.21);
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
    // Formats of 4 bytes have a mantissa of 24 bits, the shorter texts seven decimals.
    const double tolerance = format[1] == 'D' ? 1e-13 : 1e-8;
    for (double u = 0.1; u < 4.0; u += 0.37) {
      EXPECT_NEAR(z(road, u, 0.3), z(expected, u, 0.3), tolerance) << format;
    }
  }
}

TEST(OpenCrg, ArcIsAnArcAndItsNormalsAreThoseOfTheSurface) {
  // The line follows a circle of 30 m radius in 100 steps of 0.5 m: chords with the heading (i -
  // 1/2) step / radius.
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
      // The points lie on an arc of the polygon around the circle; the tolerance follows from the
      // sagitta and the angle of a step.
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
  // The headings change by one radian per meter, so the center of curvature is one meter away from
  // the reference line, which is within the width of the road.
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
  // The step is a sixtieth of the circumference of a circle with a radius of 10 m.
  text = with("= 1.0 !", "= 1.0471975512 !", text);
  text = text.substr(0, text.find("$$$$$$")) + "$$$$\n";
  for (int i = 0; i < 60; ++i) {  // one step is missing, so the line is not closed
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
  EXPECT_GT(twice.u, 60.0);  // the point near the end is closer
}

TEST(OpenCrg, SaysWhereAndWhatIsWrong) {
  expect_crg_message("", "road.crg: ", "no data");
  expect_crg_message(with("$$$$$$\n", "$\n"), "road.crg:15: ", "expected a section");
  expect_crg_message(with("Reference_Line_Increment", "reference_line_incremnet"),
                     "road.crg:5: ",
                     "did you mean \"reference_line_increment\"");
  expect_crg_message(with("= 1.0 !", "= fast !"), "road.crg:5: ", "expected a number");
  expect_crg_message(with("#:LRFI", "#:LXFI"), "road.crg:9: ", "expected one such as");
  expect_crg_message(with("#:LRFI\n", ""), "road.crg:13: ", "data without a format");
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
  // Contradicting statements about the surface itself are refused.
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

// Every statement of the tables of ASAM OpenCRG 1.2.0, 3.4.2 to 3.4.5, by its name in the standard.
TEST(OpenCrg, EveryStatementOfTheStandardsTablesIsTaken) {
  const std::vector<std::string> road = {"REFERENCE_LINE_START_B",
                                         "REFERENCE_LINE_END_B",
                                         "REFERENCE_LINE_OFFSET_X",
                                         "REFERENCE_LINE_OFFSET_Y",
                                         "REFERENCE_LINE_OFFSET_Z",
                                         "REFERENCE_LINE_OFFSET_PHI",
                                         "REFERENCE_LINE_START_LON",
                                         "REFERENCE_LINE_START_LAT",
                                         "REFERENCE_LINE_START_ALT",
                                         "REFERENCE_LINE_END_LON",
                                         "REFERENCE_LINE_END_LAT",
                                         "REFERENCE_LINE_END_ALT"};
  const std::vector<std::string> options = {"BORDER_MODE_U",
                                            "BORDER_MODE_V",
                                            "BORDER_OFFSET_U",
                                            "BORDER_OFFSET_V",
                                            "BORDER_SMOOTH_UBEG",
                                            "BORDER_SMOOTH_UEND",
                                            "WARN_MSGS",
                                            "WARN_CURV_LOCAL",
                                            "WARN_CURV_GLOBAL",
                                            "REFLINE_CONTINUATION",
                                            "CHECK_EPS",
                                            "CHECK_INC",
                                            "CHECK_TOL",
                                            "CHECK_PRO",
                                            "CHECK_WGS"};
  const std::vector<std::string> projection = {
      "GELL_A = 6378137", "GELL_B = 6356752.3",   "GELL_NM = USERDEFINED", "TRAN_NM = HN7",
      "TRAN_DS = 1e-6",   "TRAN_RX = 0",          "TRAN_RY = 0",           "TRAN_RZ = 0",
      "TRAN_TX = 1",      "TRAN_TY = 2",          "TRAN_TZ = 3",           "LELL_A = 6377397.155",
      "LELL_B = 6356079", "LELL_NM = BESSEL1841", "PROJ_NM = 'UTM_32U'",   "PROJ_F0 = 0.9996",
      "PROJ_P0 = 0",      "PROJ_L0 = 9",          "PROJ_E0 = 5e5",         "proj_n0 = 0 ! here"};
  std::string text = "$ROAD_CRG_OPTS\n";
  for (const std::string& name : options) text += name + " = 0\n";
  text += "$\n$ROAD_CRG_MPRO\n";
  for (const std::string& statement : projection) text += statement + "\n";
  text = with_section(text);
  std::string parameters = "$ROAD_CRG\n";
  for (const std::string& name : road) parameters += name + " = 0\n";
  const OpenCrg file = OpenCrg::parse(with("$ROAD_CRG\n", parameters, text), "road.crg");
  EXPECT_EQ(OpenCrg::parse(kPlain, "road.crg").grid.z, file.grid.z);
  EXPECT_TRUE(file.warnings.empty()) << file.warnings.front();
  // 10 road parameters, 8 options and 20 statements of the map projection do not concern the
  // surface.
  EXPECT_EQ(file.kept.size(), 10u + 8u + 20u);
  EXPECT_NE(std::find(file.kept.begin(), file.kept.end(), "proj_nm = 'UTM_32U' (map projection)"),
            file.kept.end());
  EXPECT_EQ(file.statements.size(), 7u);
  expect_crg_message(with_section("$ROAD_CRG_MPRO\nPROJ_NN = 'UTM'\n"),
                     "road.crg:9: ",
                     "did you mean \"proj_nm\"");
  expect_crg_message(with_section("$ROAD_CRG_MPRO\nPROJ_F0 = one\n"), "road.crg:9: ", "a number");
}

TEST(OpenCrg, StatementsThatContradictOrIdleEachOtherAreTold) {
  const auto warnings = [](const std::string& modifiers) {
    std::string all;
    for (const std::string& one :
         OpenCrg::parse(with_section("$ROAD_CRG_MODS\n" + modifiers), "road.crg").warnings)
      all += one + "\n";
    return all;
  };
  EXPECT_EQ(warnings("scale_z_grid = 2\n"), "");
  EXPECT_EQ(
      warnings("scale_z_grid = 0\n"),
      "road.crg:9: scale_z_grid = 0 is ignored, as the standard says of factors on heights\n");
  EXPECT_DOUBLE_EQ(z(road_of(with_section("$ROAD_CRG_MODS\nscale_z_grid = 0\n")), 2.0, 0.5), 0.09);
  EXPECT_NE(
      warnings("refpoint_x = 3\nrefline_offset_y = 2\n").find("refline_offset_y has no effect"),
      std::string::npos);
  EXPECT_NE(warnings("grid_nan_mode = 0\ngrid_nan_offset = 2\n").find("has no effect"),
            std::string::npos);
  expect_crg_message(with_section("$ROAD_CRG_MODS\nrefpoint_u = 1\nrefpoint_u_fraction = 0.5\n"),
                     "road.crg:9: ",
                     "keep one of them");
  expect_crg_message(with_section("$ROAD_CRG_MODS\nrefpoint_v_fraction = 1.5\n"),
                     "road.crg:9: ",
                     "expected 0 to 1");
  expect_crg_message(with_section("$ROAD_CRG_OPTS\nrefline_continuation = 2\n"),
                     "road.crg:9: ",
                     "expected 0 or 1");
  // refpoint_u_offset and refpoint_v_offset shift the reference point, whether the file states its
  // position (refpoint_u), its fraction of the road's length (refpoint_u_fraction) or neither.
  const auto origin = [](const std::string& modifiers) {
    return road_of(with_section("$ROAD_CRG_MODS\n" + modifiers)).point({0.0, 0.0});
  };
  EXPECT_DOUBLE_EQ(origin("refpoint_u_offset = 1.5\n").x(), -1.5);
  EXPECT_DOUBLE_EQ(origin("refpoint_u_fraction = 0.5\nrefpoint_u_offset = 1\n").x(), -3.0);
  EXPECT_DOUBLE_EQ(origin("refpoint_u = 1\nrefpoint_u_offset = 1\n").x(), -2.0);
  EXPECT_DOUBLE_EQ(origin("refpoint_v_offset = 0.25\n").y(), -0.25);
}

// handmade_platform.crg of the standard's samples contains such an exponent.
TEST(OpenCrg, AnExponentWrittenTheWrongWayRoundIsReadWhereItIsZero) {
  const OpenCrg file =
      OpenCrg::parse(with_section("$ROAD_CRG_MODS\nscale_z_grid = 2.000000000+e00\n"), "road.crg");
  EXPECT_DOUBLE_EQ(z(CrgRoad(file.grid), 2.0, 0.5), 0.18);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("road.crg:9: \"2.000000000+e00\" is taken as 2"),
            std::string::npos);
  expect_crg_message(with_section("$ROAD_CRG_MODS\nscale_z_grid = 2.0+e01\n"),
                     "road.crg:9: ",
                     "expected a number");
}

TEST(OpenCrg, AnEndThatTheLineDoesNotHaveIsTold) {
  const auto warnings = [](const std::string& statements) {
    return OpenCrg::parse(with("$ROAD_CRG\n", "$ROAD_CRG\n" + statements), "road.crg").warnings;
  };
  EXPECT_TRUE(warnings("reference_line_end_s = 0\nreference_line_end_b = 0\n").empty());
  EXPECT_EQ(warnings("reference_line_start_b = 0.05\nreference_line_end_b = 0.05\n").size(), 0u);
  for (const char* end : {"s", "b"}) {
    const auto said = warnings(std::string("reference_line_end_") + end + " = 0.1\n");
    ASSERT_EQ(said.size(), 1u) << end;
    EXPECT_NE(said[0].find("which counts all along it"), std::string::npos) << said[0];
  }
  EXPECT_EQ(warnings("reference_line_start_phi = 0\nreference_line_end_phi = 1\n").size(), 1u);
  EXPECT_EQ(warnings("reference_line_start_phi = 0\nreference_line_end_phi = 6.2831853\n").size(),
            0u);
}

TEST(OpenCrg, WithoutAFormatDataAreKrbiWithAWarning) {
  std::string head = with("#:LRFI\n", "");
  head = head.substr(0, head.find("$$$$")) + "$$$$\n";
  std::string data;
  for (int i = 0; i < 15; ++i) data += std::string("\x3f\x80\x00\x00", 4);  // 1.0F, big-endian
  const OpenCrg file = OpenCrg::parse(head + data, "road.crg");
  EXPECT_EQ(file.format, "KRBI");
  EXPECT_EQ(file.grid.z, std::vector<double>(15, 1.0));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("taken as KRBI"), std::string::npos);
}

/// A temporary folder with files; it is removed at the end.
class CrgFolder {
 public:
  CrgFolder()
      : path_(std::filesystem::temp_directory_path() / ("crgs" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_ / "roads");
  }
  ~CrgFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  std::filesystem::path refer(const std::string& name, const std::string& lines) const {
    return write(name, "$CT\n$\n$ROAD_CRG_FILE\n" + lines + "$\n");
  }
  std::string complaint(const std::filesystem::path& file) const {
    try {
      OpenCrg::read(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path path_;
};

// A section may name several files, paths on several lines and environment variables (3.4.6). If a
// statement is defined twice, the last one counts, and a section of the referring file takes
// precedence over those of the files to which it refers.
TEST(OpenCrg, SeveralReferencesAreSeveralFiles) {
  const CrgFolder folder;
  folder.write("plain.crg", kPlain);
  folder.write("roads/far.crg", with_section("$ROAD_CRG_MODS\nscale_z_grid = 5\n"));
  folder.write("double.crg", "$CT\n$\n$ROAD_CRG_MODS\nSCALE_Z_GRID = 2\n$\n");
  folder.write("triple.crg", "$CT\n$\n$ROAD_CRG_MODS\nSCALE_Z_GRID = 3\n$\n");
  const auto height = [](const std::filesystem::path& file) {
    return z(CrgRoad(OpenCrg::read(file).grid), 2.0, 0.5) / 0.09;
  };
  EXPECT_DOUBLE_EQ(height(folder.refer("a.crg", "double.crg\nplain.crg\n")), 2.0);
  EXPECT_DOUBLE_EQ(height(folder.refer("b.crg", "plain.crg ! data\n* no\n ./double.crg\n")), 2.0);
  EXPECT_DOUBLE_EQ(height(folder.refer("c.crg", "double.crg\ntriple.crg\nplain.crg\n")), 3.0);
  EXPECT_EQ(
      OpenCrg::read(folder.refer("c.crg", "double.crg\ntriple.crg\nplain.crg\n")).warnings.size(),
      1u);
  EXPECT_DOUBLE_EQ(height(folder.refer("d.crg", "roads/f\nar.crg\n")), 5.0);
  EXPECT_DOUBLE_EQ(height(folder.refer("e.crg", "roads/far.crg\ndouble.crg\n")), 2.0);
  EXPECT_DOUBLE_EQ(height(folder.refer("f.crg", "e.crg\n")), 2.0);
  // An empty section of modifiers disables those of the other file.
  EXPECT_DOUBLE_EQ(height(folder.refer("g.crg", "roads/far.crg\n$\n$ROAD_CRG_MODS\n")), 1.0);
  ::setenv("latsch_test_roads", "roads", 1);
  EXPECT_DOUBLE_EQ(height(folder.refer("h.crg", "$latsch_test_roads/far.crg\n")), 5.0);
  EXPECT_NE(folder.complaint(folder.refer("i.crg", "  $latsch_no_such/far.crg\n"))
                .find("environment variable \"latsch_no_such\" is not set"),
            std::string::npos);
  EXPECT_NE(folder.complaint(folder.refer("j.crg", "plain.crg\nnowhere.crg\n"))
                .find("j.crg:5: refers to"),
            std::string::npos);
  EXPECT_NE(
      folder.complaint(folder.refer("k.crg", "double.crg\ntriple.crg\n")).find("none has data"),
      std::string::npos);
  folder.refer("m.crg", "l.crg\n");
  EXPECT_NE(folder.complaint(folder.refer("l.crg", "m.crg\n")).find("refers back to it"),
            std::string::npos);
  EXPECT_NE(folder.complaint(folder.write("n.crg", with_section("$ROAD_CRG_FILE\nplain.crg\n")))
                .find("expected one of both"),
            std::string::npos);
  const auto road = folder.write("o.crg",
                                 "$ROAD_CRG\nreference_line_increment = 2\n$\n"
                                 "$ROAD_CRG_FILE\nplain.crg\n$\n");
  ASSERT_EQ(OpenCrg::read(road).warnings.size(), 1u);
  EXPECT_NE(OpenCrg::read(road).warnings[0].find("its $ROAD_CRG has no effect"), std::string::npos);
  EXPECT_EQ(files_of_road(folder.refer("f.crg", "e.crg\n")).size(), 4u);
}

struct Reference {
  double x, y, u, v, z;
};

// The reference heights are those of an independent program, the C library of OpenCRG 1.2.0,
// without modifiers and with default options. It stores heights in single precision.
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
