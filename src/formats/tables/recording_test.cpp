// SPDX-License-Identifier: Apache-2.0
#include "formats/tables/recording.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "base/scratch_folder_testing.h"
#include "base/spoiled_text_testing.h"
#include "formats/tables/csv_table.h"
#include "formats/tables/lab_table.h"

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

TEST(Recording, ThatEndsWithinARowIsReadWithoutTheRowAndSaysSo) {
  const ScratchFolder folder;
  for (const char* end : {"0.2", "0.2,"}) {
    write_text_file(folder / "cut.csv", std::string("t [s],F [N]\n0,1\n0.1,2\n") + end);
    const Recording recording = read_whole_recording(folder / "cut.csv");
    EXPECT_EQ(recording.channels["F"], (std::vector<double>{1.0, 2.0}));
    ASSERT_EQ(recording.doubts.size(), 1u);
    EXPECT_EQ(recording.doubts.front().sentence,
              "the file is cut off within this line, which is left out");
    EXPECT_EQ(recording.doubts.front().place.line, 4);
    EXPECT_THROW(read_recording(folder / "cut.csv"), InputError);  // channels alone cannot say it
  }
}

// Every kind of file that read_lab_table() reads can be a recording.
TEST(Recording, IsEveryKindOfLaboratoryFile) {
  const ScratchFolder folder;
  const std::string head = "Tire: 16.0x7.5-10 Run: 4\nET\tFZ\nsec\tkN\n";
  write_text_file(folder / "run4.dat", head + "0\t1.5\n0.01\t1.6\n");
  const Recording recording = read_whole_recording(folder / "run4.dat");
  ASSERT_EQ(recording.channels.all().size(), 2u);
  EXPECT_EQ(recording.channels["FZ"][1], 1600.0);
  EXPECT_EQ(recording.header_line, 3);
  write_text_file(folder / "gap.dat", head + "0\t1.5\n0.01\tNaN\n");
  try {
    read_whole_recording(folder / "gap.dat");
    FAIL() << "a gap";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().line, 5);
    EXPECT_NE(std::string(error.what()).find("FZ is no finite number"), std::string::npos);
  }
  try {
    read_recording(folder / "run.xls");
    FAIL() << "an unknown kind";
  } catch (const InputError& error) {
    for (const std::string& ending : lab_endings())
      EXPECT_NE(std::string(error.what()).find(ending), std::string::npos) << ending;
  }
}

TEST(Recording, SpoiledOnesEndInFiniteNumbersOrAnInputError) {
  constexpr std::uint64_t kSeed = 2018;
  constexpr int kMutations = 20'000;
  const std::vector<std::string> recordings{
      "# rig 3\ntime [ms],speed [km/h],Fz [N]\n0,36,4000\n0.5,36.1,4012.5\n1,36,-2e3\n",
      "time;Fz\r\ns;kN\r\n0,5;1,5\r\n0,6;1,6\r\n"};
  const std::vector<std::string> pieces{",",
                                        ";",
                                        "\t",
                                        "\n",
                                        "\"",
                                        "#",
                                        "[",
                                        "]",
                                        "nan",
                                        "inf",
                                        "1e999",
                                        "1e308",
                                        "-",
                                        "3,5",
                                        "\xff",
                                        std::string(1, '\0')};
  int rejected = 0;
  for (int i = 0; i < kMutations; ++i) {
    RandomStream random(kSeed, i);
    const std::string text = spoiled(recordings[random.below(recordings.size())], pieces, random);
    try {
      const Channels channels = parse_recording(text, "spoiled.csv");
      for (const Channel& channel : channels.all()) {
        ASSERT_EQ(channel.values.size(), channels.all()[0].values.size()) << text;
        for (const double value : channel.values) ASSERT_TRUE(std::isfinite(value)) << text;
      }
    } catch (const InputError& error) {
      ++rejected;
    }
  }
  EXPECT_GT(rejected, kMutations / 10);
  EXPECT_LT(rejected, kMutations);
}

// A column that is not needed may have an unknown unit.
TEST(Recording, LeavesOutAColumnOfAnUnknownUnitWithTheReason) {
  const ScratchFolder folder;
  write_text_file(folder / "r.csv", "time [s],Fz [kN],odd [grC]\n0,1,x\n1,2,y\n");
  const auto recording = read_whole_recording(folder / "r.csv");
  EXPECT_EQ(recording.channels["Fz"], (std::vector<double>{1000.0, 2000.0}));
  EXPECT_EQ(recording.columns.size(), 2u);
  ASSERT_TRUE(recording.left_out.contains("odd"));
  EXPECT_NE(recording.left_out.at("odd").find("unknown unit \"grC\""), std::string::npos);
  EXPECT_THROW(read_recording(folder / "r.csv"), InputError);
}

}  // namespace
}  // namespace latsch::formats
