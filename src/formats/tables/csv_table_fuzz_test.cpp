// SPDX-License-Identifier: Apache-2.0
// Reading a damaged table must give finite numbers, equally many in each column, or an InputError.
#include <gtest/gtest.h>

#include <cmath>

#include "base/spoiled_text_testing.h"
#include "formats/tables/csv_table.h"

namespace latsch::formats {
namespace {

constexpr std::uint64_t kSeed = 4180;
constexpr int kMutations = 20'000;

const std::vector<std::string> kTables = {
    "# rig 3\ndeflection [mm],force [N],type\n5.0,812,lateral\n10.0,1743.5,\"radial, "
    "2\"\n20,4012,x\n",
    "Weg;Kraft\r\nmm;kN\r\n5,0;0,812\r\n10,0;1,7435\r\n20,0;4,012\r\n",
    "frequency [Hz]\tn\ttype\n41.5\t1\tlateral\n78.2\t1\tradial\n"};
const std::vector<std::string> kPieces = {",",
                                          ";",
                                          "\t",
                                          "\n",
                                          "\r\n",
                                          "\"",
                                          "\"\"",
                                          "#",
                                          "[",
                                          "]",
                                          "[mm]",
                                          "[barr]",
                                          "nan",
                                          "inf",
                                          "1e999",
                                          "-",
                                          "3,5",
                                          "3.5",
                                          std::string(1, '\0'),
                                          "\xff",
                                          "\xef\xbb\xbf",
                                          "force [N]",
                                          " "};

TEST(CsvTableFuzz, TwentyThousandSpoiledTablesEndInNumbersOrAnInputError) {
  int rejected = 0;
  for (int i = 0; i < kMutations; ++i) {
    RandomStream random(kSeed, i);
    const std::string text = spoiled(kTables[random.below(kTables.size())], kPieces, random);
    try {
      const CsvTable table = CsvTable::parse(text, "spoiled.csv");
      for (const std::string& name : table.columns()) {
        ASSERT_EQ(table.texts(name).size(), static_cast<std::size_t>(table.rows()));
      }
      const Channels channels = table.channels();
      for (const Channel& channel : channels.all()) {
        ASSERT_EQ(channel.values.size(), static_cast<std::size_t>(table.rows()));
        for (double value : channel.values) ASSERT_TRUE(std::isfinite(value)) << text;
      }
    } catch (const InputError& error) {
      ++rejected;
      ASSERT_EQ(std::string(error.what()).find("spoiled.csv"), 0u) << error.what();
    }
  }
  // At least a quarter of the damaged tables must be refused, and a considerable share must be
  // read.
  EXPECT_GT(rejected, kMutations / 4);
  EXPECT_LT(rejected, 19 * kMutations / 20);
}

}  // namespace
}  // namespace latsch::formats
