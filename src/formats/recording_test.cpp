// SPDX-License-Identifier: Apache-2.0
#include "formats/recording.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "formats/csv_table.h"

namespace latsch::formats {
namespace {

void refused(const std::string& text, const std::string& part) {
  try {
    parse_recording(text, "run.csv");
    FAIL() << text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Recording, ComesOutInSi) {
  const auto channels = parse_recording(
      "# a rig\r\ntime [ms],speed [km/h],\"Fz, wheel [kN]\"\r\n0,36,4\r\n0.5,+72,-4.25\r\n", "f");
  EXPECT_EQ(channels.all()[0].unit, "s");
  EXPECT_EQ(channels["time"], (std::vector<double>{0.0, 0.0005}));
  EXPECT_NEAR(channels["speed"][1], 20.0, 1e-14);
  EXPECT_EQ(channels["Fz, wheel"], (std::vector<double>{4000.0, -4250.0}));
}

TEST(Recording, HasDecimalCommasAndARowOfUnits) {
  const auto channels = parse_recording("time;Fz;n\ns;kN;-\n0,5;1,5;3\n", "f");
  EXPECT_EQ(channels["time"][0], 0.5);
  EXPECT_EQ(channels["Fz"][0], 1500.0);
  EXPECT_EQ(channels.all()[2].unit, "1");
}

TEST(Recording, OfSiUnitsIsTheTablesToTheBit) {
  Channels channels;
  channels.add({"t", "s", {0.1, 1.0 / 3.0, 2e-17}});
  channels.add({"F", "N", {-1e300, 0.0, 5.0}});
  const std::string text = csv_text(channels);
  EXPECT_EQ(parse_recording(text, "f"), channels);
  EXPECT_EQ(CsvTable::parse(text, "f").channels(), channels);
}

TEST(Recording, IsRefusedInWords) {
  refused("", "is empty");
  refused("t [s],F [N]\n0,1\n1,nan\n", "run.csv:3: F is \"nan\", expected a finite number");
  refused("t [s],F [N]\n0,1\n1,\n", "run.csv:3: F is empty");
  refused("t [s],F [N]\n0,1,2\n", "run.csv:2: has 3 fields, expected 2");
  refused("t [s],F [Nn]\n0,1\n", "unknown unit \"Nn\"");
  refused("t [s],t [s]\n0,1\n", "comes twice");
  refused("0,1\n1,2\n", "expected a line of column names");
  EXPECT_THROW(read_recording("run.xls"), InputError);
}

}  // namespace
}  // namespace latsch::formats
