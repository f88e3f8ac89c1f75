// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_conflict.h"

#include <gtest/gtest.h>

#include "base/scratch_folder_testing.h"
#include "correlation/doe/linear_study_testing.h"
#include "optimization/design/full_factorial.h"

namespace latsch::correlation {
namespace {

/// F = a x + b, measured 50, 70, 90 and 110 N with 5 % of noise, at most 35, 50, 65 and 80 N inside
/// the bounds.
Study study_out_of_reach(double noise = 0.05) {
  Study study = linear_study();
  study.experiments.pop_back();
  study.experiments[0].noise = {.relative = noise};
  study.space = DesignSpace({{"a", {"a"}, 1e3, 3e3, 2e3}, {"b", {"a"}, 0.0, 20.0, 10.0}});
  return study;
}

DoeConflict conflict_of_grid(const Study& study, int levels) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "springs.latsch", {{"model", "linear springs"}});
  const auto points = full_factorial(study.space, {levels, levels}).points;
  for (const DesignPoint& point : points) {
    Channels channels;
    channels.add({"press/force", "N", linear_forces(point, false)});
    journal.append({point, {Result<Channels>(channels)}});
  }
  return doe_conflict(study, points, journal);
}

// The upper corner of the grid comes nearest. The first value is 15 N beyond it, 6 deviations of
// 2.5 N, the others by 20, 25 and 30 N or 5.7, 5.6 and 5.5 deviations. Over its range a moves the
// mean distance by (10/2.5 + 20/3.5 + 30/4.5 + 40/5.5)/4 = 5.9, b by (8 + 5.7 + 4.4 + 3.6)/4 = 5.4.
TEST(DoeConflict, NamesValuesBeyondAllPointsAndTheVariableThatMovesThemMost) {
  const Study study = study_out_of_reach();
  const DoeConflict found = conflict_of_grid(study, 6);
  ASSERT_TRUE(found.refusal.empty()) << found.refusal;
  EXPECT_EQ(found.points, 36);
  const UnreachedValues& row = found.rows.at(0);
  EXPECT_EQ(row.values, 4);
  EXPECT_EQ(row.beyond, 4);
  EXPECT_EQ(row.between, 0);
  EXPECT_EQ(row.farthest, "5 mm");
  EXPECT_NEAR(row.farthest_by, 6.0, 1e-9);
  EXPECT_EQ(row.mover, 0);
  EXPECT_TRUE(row.is_raised);
  EXPECT_EQ(
      in_words(study, row),
      "4 of 4 values beyond every point, 5 mm by 6.0 deviations; most moved by a, which would "
      "have to be larger");
}

TEST(DoeConflict, IsNoneWhereTheNoiseReachesThePoints) {
  const DoeConflict found = conflict_of_grid(study_out_of_reach(0.11), 6);
  EXPECT_EQ(found.rows.at(0).beyond, 0);
  EXPECT_EQ(found.rows.at(0).mover, -1);
}

// Inside wide bounds the values lie among the points of a grid that is too coarse to come near.
TEST(DoeConflict, TellsValuesBetweenPointsFromThoseBeyondThem) {
  Study study = study_out_of_reach(1e-5);
  study.space = DesignSpace({{"a", {"a"}, -2e4, 2.1e4, 2e3}, {"b", {"a"}, -2e2, 2.1e2, 10.0}});
  const UnreachedValues row = conflict_of_grid(study, 6).rows.at(0);
  EXPECT_EQ(row.beyond, 0);
  EXPECT_EQ(row.between, 4);
  EXPECT_NE(in_words(study, row).find("too far apart to tell"), std::string::npos);
}

TEST(DoeConflict, RefusesADesignOfFewerThanTenPointsAVariable) {
  const DoeConflict found = conflict_of_grid(study_out_of_reach(), 5);
  EXPECT_TRUE(found.rows.empty());
  EXPECT_NE(found.refusal.find("25 points of a design succeeded, expected 30 at least"),
            std::string::npos)
      << found.refusal;
}

}  // namespace
}  // namespace latsch::correlation
