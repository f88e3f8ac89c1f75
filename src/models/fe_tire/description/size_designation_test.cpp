// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/description/size_designation.h"

#include <gtest/gtest.h>

namespace latsch::fe_tire {
namespace {

TEST(SizeDesignation, MetricSizeIsWidthAspectRatioAndRim) {
  const auto size = parse_size("225/50R16");
  ASSERT_TRUE(size);
  EXPECT_DOUBLE_EQ(size->width, 0.225);
  EXPECT_DOUBLE_EQ(size->rim_diameter, 0.4064);
  EXPECT_DOUBLE_EQ(size->outer_diameter, 0.4064 + 0.225);  // two section heights of 50 %
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
