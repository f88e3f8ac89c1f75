// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/size_designation.h"

#include <gtest/gtest.h>

#include <vector>

namespace latsch::fe_tire {
namespace {

TEST(SizeDesignation, MetricSizeIsWidthAspectRatioAndRim) {
  const auto size = parse_size("225/50R16");
  ASSERT_TRUE(size);
  EXPECT_DOUBLE_EQ(size->width, 0.225);
  EXPECT_DOUBLE_EQ(size->rim_diameter, 0.4064);
  // Rim diameter plus two section heights of 50 % of the width.
  EXPECT_DOUBLE_EQ(size->outer_diameter, 0.4064 + 0.225);
  EXPECT_TRUE(size->metric && size->radial);
}

TEST(SizeDesignation, RacingSizeIsDiameterWidthAndRimInInches) {
  const auto size = parse_size("16x7.5-10");
  ASSERT_TRUE(size);
  EXPECT_DOUBLE_EQ(size->outer_diameter, 0.4064);
  EXPECT_DOUBLE_EQ(size->width, 0.1905);
  EXPECT_DOUBLE_EQ(size->rim_diameter, 0.254);
  EXPECT_FALSE(size->metric || size->radial);
}

TEST(SizeDesignation, MarksAroundTheSizeAreAllowed) {
  for (const char* text : {"P205/55ZR16", "205/55 R16 91V", "LT205/55R16", "205/55R16 XL"})
    EXPECT_TRUE(parse_size(text)) << text;
}

// Reference diameters in mm are from manufacturers' tables. They must be met within the tolerance
// of the designation.
TEST(SizeDesignation, SizesOfTrucksFieldsMinesAircraftAndMotorcyclesAreRead) {
  struct Row {
    const char* text;
    double width, rim, outer;  // mm
    bool radial;
  };
  const std::vector<Row> rows = {{"138x41-84", 41 * 25.4, 84 * 25.4, 138 * 25.4, false},
                                 {"31x10.50R15LT", 10.5 * 25.4, 381.0, 31 * 25.4, true},
                                 {"46x17.0R20", 17 * 25.4, 508.0, 46 * 25.4, true},
                                 {"H44.5x16.5-21", 16.5 * 25.4, 21 * 25.4, 44.5 * 25.4, false},
                                 {"1400x530R23", 530.0, 23 * 25.4, 1400.0, true},
                                 {"10.00R20", 254.0, 508.0, 1054.0, true},
                                 {"11R22.5", 279.4, 571.5, 1054.0, true},
                                 {"7.50-16", 190.5, 406.4, 805.0, false},
                                 {"18.4-38", 18.4 * 25.4, 38 * 25.4, 1750.0, false},
                                 {"40.00R57", 1016.0, 57 * 25.4, 3594.0, true},
                                 {"59/80R63", 59 * 25.4, 63 * 25.4, 4022.0, true},
                                 {"VF710/70R42", 710.0, 42 * 25.4, 2061.0, true},
                                 {"185R14C", 185.0, 355.6, 650.0, true},
                                 {"195/70R15C 104/102R", 195.0, 381.0, 654.0, true},
                                 {"265/70R17LT", 265.0, 431.8, 803.0, true},
                                 {"275/35 R19 100Y XL", 275.0, 482.6, 675.0, true},
                                 {"p275/35zr19", 275.0, 482.6, 675.0, true},
                                 {"205/60VR15", 205.0, 381.0, 627.0, true},
                                 {"190/65R390", 190.0, 390.0, 637.0, true},
                                 {"120/70ZR17M/C (58W)", 120.0, 431.8, 600.0, true},
                                 {"80/100-21", 80.0, 21 * 25.4, 693.0, false},
                                 {"T125/80D17", 125.0, 431.8, 632.0, false},
                                 {"16\u00d77.5-10", 190.5, 254.0, 406.4, false}};
  for (const Row& row : rows) {
    const auto size = parse_size(row.text);
    ASSERT_TRUE(size) << row.text;
    EXPECT_NEAR(size->width, 1e-3 * row.width, 1e-12) << row.text;
    EXPECT_NEAR(size->rim_diameter, 1e-3 * row.rim, 1e-12) << row.text;
    EXPECT_NEAR(1e-3 * row.outer / size->outer_diameter, 1.0, size->diameter_tolerance) << row.text;
    EXPECT_EQ(size->radial, row.radial) << row.text;
  }
}

TEST(SizeDesignation, WhatIsNoSizeIsRefused) {
  for (const char* text :
       {"", "225-50-16", "225/50R", "16x7.5", "10x7.5-16", "000/50R16", "225/50Q16", "1e9/50R16"})
    EXPECT_FALSE(parse_size(text)) << text;
  EXPECT_FALSE(parse_size(std::string(100000, '2')));
}

TEST(SizeDesignation, ConflictSaysWhichDimensionAndHowMuch) {
  const auto size = *parse_size("225/50R16");
  EXPECT_EQ(size_conflict(size, 0.319, 0.2338, {0.085, 0.211}), "");
  EXPECT_NE(size_conflict(size, 0.340, 0.2338, {0.085, 0.211}).find("680.0 mm"), std::string::npos);
  EXPECT_NE(size_conflict(size, 0.319, 0.300, {0.085, 0.211}).find("300.0 mm"), std::string::npos);
  EXPECT_NE(size_conflict(size, 0.319, 0.2338, {0.085, 0.190}).find("190.0 mm"), std::string::npos);
}

}  // namespace
}  // namespace latsch::fe_tire
