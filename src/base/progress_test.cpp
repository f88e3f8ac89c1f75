// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

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
  for (int done = 50; done <= 60; ++done, time += 1.0) progress.update(done, 100);
  EXPECT_EQ(out.str(),
            "50/100 (50 %)\n"
            "55/100 (55 %), 45 s left\n"
            "60/100 (60 %), 40 s left\n");
}

/// Returns the lines that a pipe gets if evaluations finish at these times, s; an update that no
/// line shows is left out.
std::string lines_of(const std::vector<double>& times, const std::vector<long>& totals) {
  std::ostringstream out;
  double time = 0.0;
  Progress progress(out, false, [&] { return time; });
  progress.update(0, totals.front());
  for (std::size_t i = 0; i < times.size(); ++i) {
    time = times[i];
    progress.update(static_cast<long>(i) + 1, totals[std::min(i, totals.size() - 1)]);
  }
  return out.str();
}

// The first evaluation of 100 takes 60 s, all others 6 s: the first ones say nothing of the end.
TEST(Progress, SaysNoEndInTheFirstEvaluationsAndARangeBeforeASingleTime) {
  std::vector<double> times = {60.0};
  while (times.size() < 99) times.push_back(times.back() + 6.0);
  const std::string lines = lines_of(times, {100});
  EXPECT_NE(lines.find("\n1/100 (1 %)\n2/100 (2 %)\n3/100 (3 %), 9:42 to 38:48 left\n"), lines.npos)
      << lines;
  // 9:42 are left in truth
  EXPECT_NE(lines.find("\n20/100 (20 %), 8:00 to 11:36 left\n"), lines.npos) << lines;  // 8:00
  EXPECT_NE(lines.find("\n95/100 (95 %), 31 s left\n"), lines.npos) << lines;           // 30 s
}

// Eight workers finish 160 evaluations of 10 s in rounds, within 1.4 s of each other. Every
// time that is said is right within a fifth or the 10 s of an evaluation, and every range holds the
// truth within that.
TEST(Progress, ARangeHoldsTheTruthWhenWorkersFinishInRounds) {
  std::vector<double> times;
  for (int i = 0; i < 160; ++i) times.push_back(10.0 * (i / 8 + 1) + 0.2 * (i % 8));
  std::ostringstream out;
  double time = 0.0;
  Progress progress(out, false, [&] { return time; });
  progress.update(0, 160);
  int ranges = 0, single = 0;
  for (int i = 0; i < 159; ++i) {
    time = times[static_cast<std::size_t>(i)];
    out.str("");
    progress.update(i + 1, 160);
    const std::string line = out.str();
    const auto left = line.find(" left");
    if (left == line.npos) continue;
    const auto seconds = [](const std::string& text) {
      double sum = 0.0;
      std::istringstream parts(text.substr(0, text.find(' ')));
      for (std::string part; std::getline(parts, part, ':');) sum = 60.0 * sum + std::stod(part);
      return sum;
    };
    const auto from = line.rfind(", ", left) + 2, to = line.find(" to ", from);
    const double truth = times.back() - time;
    const double least = seconds(line.substr(from));
    const double most = to == line.npos ? least : seconds(line.substr(to + 4));
    to == line.npos ? ++single : ++ranges;
    EXPECT_LE(least, 1.2 * truth + 10.0) << line;
    EXPECT_GE(most, 0.8 * truth - 10.0) << line;
  }
  EXPECT_GT(ranges, 0);
  EXPECT_GT(single, 0);
}

// The total is a forecast that falls from 1000 to 100 while one evaluation a second finishes.
TEST(Progress, ATotalThatChangesSpreadsTheEnd) {
  std::vector<double> times;
  std::vector<long> totals;
  for (int i = 1; i <= 90; ++i) {
    times.push_back(i);
    totals.push_back(i < 12 ? 1000 : i < 20 ? 300 : 100);
  }
  const std::string lines = lines_of(times, totals);
  EXPECT_NE(lines.find("\n10/1000 (1 %), 16:30 left\n"), lines.npos) << lines;
  EXPECT_NE(lines.find("\n20/100 (20 %)\n"), lines.npos) << lines;
  EXPECT_NE(lines.find("\n25/100 (25 %), 1:15 to 4:35 left\n"), lines.npos) << lines;
  EXPECT_NE(lines.find("\n40/100 (40 %), 1:00 left\n"), lines.npos) << lines;
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
