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
  EXPECT_EQ(levels,
            (std::set<std::string>{"Fz 1020 N, gamma 0 deg",
                                   "Fz 1020 N, gamma 2 deg",
                                   "Fz 3020 N, gamma 0 deg",
                                   "Fz 3020 N, gamma 2 deg"}));
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

// A state list that a person wrote: few samples at each inclination and pressure, or one.
TEST_F(Abscissas, FewStatesOfAnotherInclinationOrPressureAreNoPartOfTheLine) {
  const std::string head = "Fz [N],alpha [deg],gamma [deg],p [kPa],Fy [N]\n";
  const NaturalAbscissa leaned = of(head +
                                        "3000,1,0,83,-900\n3000,4,0,83,-2600\n3000,8,0,83,-3000\n"
                                        "3000,2,2,83,-1700\n3000,5,4,83,-2900\n",
                                    "Fy");
  EXPECT_EQ(leaned.channel, "alpha");
  ASSERT_EQ(leaned.groups.size(), 3u);
  EXPECT_EQ(leaned.groups[0].name, "gamma 0 deg");
  EXPECT_EQ(leaned.groups[0].end - leaned.groups[0].from, 3u);
  EXPECT_EQ(leaned.groups[1].level, "gamma 2 deg");  // a row of the legend
  EXPECT_EQ(leaned.groups[2].name, "gamma 4 deg");
  const NaturalAbscissa blown =
      of(head + "3000,1,0,69,-900\n3000,4,0,69,-2600\n3000,8,0,97,-3000\n", "Fy");
  ASSERT_EQ(blown.groups.size(), 2u);
  EXPECT_EQ(blown.groups[1].name, "p 97 kPa");
  // inclinations close to each other beside a large one
  std::string close = head;
  for (const double gamma : {0.0, 0.5, 1.0, 5.0, 10.0})
    for (int k = -2; k <= 2; ++k)
      close += fmt::format("3000,{},{},83,{}\n", 3 * k, gamma, -1000 * k);
  EXPECT_EQ(of(close, "Fy").groups.size(), 5u);
}

// An inclination that drifts with the slip angle within the scatter of a rig is one condition.
TEST_F(Abscissas, ScatterOfTheInclinationFormsNoGroups) {
  std::string table = "Fz [N],alpha [deg],gamma [deg],Fy [N]\n";
  for (int k = -6; k <= 6; ++k)
    table += fmt::format("{},{},{},{}\n", 3000 + 9 * k, k, 0.02 * k, -500 * k);
  EXPECT_EQ(of(table, "Fy").groups.size(), 1u);
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
