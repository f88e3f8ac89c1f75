// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"

#include <gtest/gtest.h>

#include <sstream>

namespace latsch {
namespace {

TEST(Progress, PipesGetFewPlainLines) {
  std::ostringstream out;
  double time = 100.0;
  Progress progress(out, false, [&] { return time; });
  for (int done = 0; done <= 100; ++done, time += 0.125) progress.update(done, 100, "best 0.5");
  EXPECT_EQ(out.str(),
            "0/100 (0 %), best 0.5\n"
            "40/100 (40 %), 8 s left, best 0.5\n"
            "80/100 (80 %), 3 s left, best 0.5\n"
            "100/100 (100 %), 13 s, best 0.5\n");
}

TEST(Progress, TerminalsGetABarThatCoversTheOneBefore) {
  std::ostringstream out;
  double time = 0.0;
  {
    Progress progress(
        out, true, [&] { return time; }, 100);
    progress.update(1, 2, "a long note");
    time = 10.0;
    progress.update(2, 2);
  }
  EXPECT_EQ(out.str(),
            "\r[###############...............] 1/2 (50 %), a long note"
            "\r[##############################] 2/2 (100 %), 10 s      \n");
}

TEST(Progress, ABarIsNeverWiderThanTheTerminal) {
  std::ostringstream out;
  Progress progress(
      out, true, [] { return 0.0; }, 20);
  progress.update(1, 2, "a long note");
  EXPECT_EQ(out.str(), "\r[###############...");
}

// 50 of 100 results come from a journal at once; afterwards one result a second arrives.
TEST(Progress, WhatWasKnownAtTheStartSaysNothingAboutTheSpeed) {
  std::ostringstream out;
  double time = 0.0;
  Progress progress(out, false, [&] { return time; });
  progress.update(50, 100);
  time = 10.0;
  progress.update(60, 100);
  EXPECT_EQ(out.str(), "50/100 (50 %)\n60/100 (60 %), 40 s left\n");
}

TEST(Progress, AnOpenEndHasNoBar) {
  std::ostringstream out;
  Progress progress(out, false, [] { return 0.0; });
  progress.update(7, 0);
  EXPECT_EQ(out.str(), "7 done, 0 s\n");
}

TEST(Progress, TheLastStateIsPrintedInAnyCase) {
  std::ostringstream out;
  {
    Progress progress(out, false, [] { return 0.0; });
    progress.update(0, 0, "0 failed");
    progress.update(6, 0, "6 failed");
  }
  EXPECT_EQ(out.str(), "0 done, 0 s, 0 failed\n6 done, 0 s, 6 failed\n");
}

TEST(Progress, DurationsReadLikeAClock) {
  EXPECT_EQ(format_duration(7.4), "7 s");
  EXPECT_EQ(format_duration(59.6), "1:00");
  EXPECT_EQ(format_duration(3725.0), "1:02:05");
  EXPECT_EQ(format_duration(-1.0), "0 s");
}

}  // namespace
}  // namespace latsch
