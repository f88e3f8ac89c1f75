// SPDX-License-Identifier: Apache-2.0
#include "formats/mesh/ccx_results.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch::formats {
namespace {

const std::filesystem::path kResults = LATSCH_SOURCE_DIR "/../shared/data/ccx";

TEST(CcxResults, ForcesAndFrequenciesOfTheLoadedTireB) {
  if (!std::filesystem::exists(kResults)) GTEST_SKIP() << "no results in " << kResults;
  const CcxResults results = read_ccx_results(kResults / "tire_b_loaded.dat");
  EXPECT_DOUBLE_EQ(results.total_force.at("NGR").y(), 7428.921);
  ASSERT_EQ(results.frequencies.size(), 20u);
  EXPECT_DOUBLE_EQ(results.frequencies.front(), 32.22207);
  EXPECT_DOUBLE_EQ(results.frequencies.back(), 190.2919);
}

TEST(CcxResults, TablesAreToldApartByTheirTitles) {
  const CcxResults results = parse_ccx_results(
      " displacements (vx,vy,vz) for set SENSORS and time  0.1000000E+01\n\n"
      "         7 -1.000000E-03 -8.330000E-01  0.000000E+00\n\n"
      " total force (fx,fy,fz) for set GROUND and time  0.2000000E+01\n\n"
      "        1.0  2.0  3.0\n",
      "x.dat");
  EXPECT_DOUBLE_EQ(results.displacement.at(7).y(), -0.833);
  EXPECT_DOUBLE_EQ(results.total_force.at("GROUND").z(), 3.0);
  EXPECT_TRUE(results.frequencies.empty());
}

TEST(CcxResults, ACutRowIsNamedWithItsLine) {
  try {
    parse_ccx_results(" total force (fx,fy,fz) for set A and time  1.\n\n 1.0 2.0\n", "x.dat");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().line, 3);
  }
}

}  // namespace
}  // namespace latsch::formats
