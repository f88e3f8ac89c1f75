// SPDX-License-Identifier: Apache-2.0
// Curves over a slip angle are grouped by their loads.
#include "correlation/laboratory/natural_abscissa.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "base/file.h"
#include "base/scratch_folder_testing.h"

namespace latsch::correlation {
namespace {

class Abscissas : public testing::Test {
 protected:
  NaturalAbscissa of(const std::string& table, const std::string& y) {
    write_text_file(folder_ / "run.csv", table);
    write_text_file(folder_ / "study.toml",
                    "[measurement.run]\nfile = \"run.csv\"\naxes = \"iso\"\n");
    const Document document = Document::read(folder_ / "study.toml");
    const Laboratory laboratory = read_laboratory(document.root(), folder_.path());
    return natural_abscissa(*find(laboratory, "run"), y).value();
  }

  ScratchFolder folder_;
};

/// A cornering run of five loads that a rig holds within 5 %, at two camber angles.
std::string cornering() {
  std::string table = "Fz [N],alpha [deg],gamma [deg],Fy [N]\n";
  for (const double load : {530.0, 1100.0, 1660.0, 2070.0, 2600.0})
    for (const double gamma : {0.0, 1.6})
      for (int k = 0; k < 25; ++k)
        table += fmt::format("{},{},{},{}\n",
                             load + 6.0 * (k - 12),
                             k - 12,
                             gamma + (k % 2 ? -1e-3 : -2e-3),
                             -100 * (k - 12));
  return table;
}

TEST_F(Abscissas, LoadsFormLevelsAlsoIfTheyAreManyAndUneven) {
  const NaturalAbscissa over = of(cornering(), "Fy");
  EXPECT_EQ(over.channel, "alpha");
  ASSERT_EQ(over.groups.size(), 10u);
  std::set<std::string> levels, names;
  for (const auto& group : over.groups) {
    EXPECT_EQ(group.end - group.from, 25u) << group.name;
    levels.insert(group.level);
    names.insert(group.name);
  }
  EXPECT_EQ(
      levels,
      (std::set<std::string>{"Fz 530 N", "Fz 1100 N", "Fz 1660 N", "Fz 2070 N", "Fz 2600 N"}));
  EXPECT_EQ(names.size(), 10u);
  EXPECT_EQ(names.count("Fz 530 N, gamma 0 deg"), 1u) << *names.begin();  // not -0 deg
}

TEST_F(Abscissas, AGroupIsNamedByItsLevelAndNotByItsOwnScatter) {
  std::string table = "Fz [N],alpha [deg],gamma [deg],Fy [N]\n";
  for (const double gamma : {0.0, 2.0})
    for (const double load : {1000.0, 3000.0})
      for (int k = -5; k <= 5; ++k)
        table += fmt::format("{},{},{},{}\n", load + 20.0 * gamma, k, gamma, -100 * k);
  std::set<std::string> levels;
  for (const auto& group : of(table, "Fy").groups) levels.insert(group.level);
  EXPECT_EQ(levels, (std::set<std::string>{"Fz 1020 N", "Fz 3020 N"}));
}

// The camber covers a larger share of its usual range than the slip does, but it has only four
// levels.
TEST_F(Abscissas, AChannelOfFewLevelsIsNoSweep) {
  std::string table = "Fz [N],alpha [deg],kappa,gamma [deg],Fy [N],Fx [N]\n", braked = table;
  for (const double gamma : {0.0, 2.0, 4.0, 6.0})
    for (const double load : {2000.0, 4000.0})
      for (int k = -10; k <= 10; ++k) {
        table += fmt::format("{},{},0,{},{},0\n", load, 0.5 * k, gamma, -100 * k);
        braked += fmt::format("{},{},{},0,0,{}\n", load, 2.0 * gamma, 0.01 * k, 100 * k);
      }
  const NaturalAbscissa over = of(table, "Fy");
  EXPECT_EQ(over.channel, "alpha");
  EXPECT_EQ(over.groups.size(), 8u);
  EXPECT_EQ(of(braked, "Fx").channel, "kappa");
}

TEST_F(Abscissas, ALoadThatRisesWithTheTravelFormsNoGroups) {
  std::string table = "dz [mm],Fz [N],toe [deg]\n";
  for (int k = 0; k < 6; ++k) table += fmt::format("{},{},{}\n", 20 * k, 1000 + 600 * k, 0.1 * k);
  const NaturalAbscissa over = of(table, "toe");
  EXPECT_EQ(over.channel, "dz");
  EXPECT_EQ(over.groups.size(), 1u);
}

TEST_F(Abscissas, ASweepOfTheLoadFormsNoGroups) {
  std::string table = "Fz [N],alpha [deg],Fy [N]\n";
  for (int k = 0; k < 100; ++k)
    table += fmt::format("{},{},{}\n", 500 + 30 * k, (k * 37) % 21 - 10, k);
  EXPECT_EQ(of(table, "Fy").groups.size(), 1u);
}

}  // namespace
}  // namespace latsch::correlation
