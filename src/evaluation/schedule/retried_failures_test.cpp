// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/retried_failures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/scratch_folder_testing.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/schedule/scheduler.h"
#include "optimization/direct_search/gss.h"

namespace latsch {
namespace {

const StudyIdentity kRetriedStudy{{"model", "a"}};
const Failure kTooLong{"took more than the 5 s allowed and was killed", Cause::timeout};
const Failure kProgramTooLong{"\"ccx\" took more than the 2 s allowed to it and was killed",
                              Cause::timeout};
const Failure kNoRoom{"out of memory"};
const Failure kBuckles{"load step 3: no equilibrium"};

Trial trial(double x, Result<Channels> result) { return {{{x}}, {.result = std::move(result)}}; }

std::vector<double> counting(const Journal& journal) {
  std::vector<double> points;
  TrialsThatCount(journal).for_each(
      [&](const Trial& t) { points.push_back(t.point.values.front()); });
  return points;
}

struct Failed : testing::Test {
  ScratchFolder folder;
  Journal journal = Journal::open(folder / "a", kRetriedStudy);

  Failed() {
    retry_what_limits_forbade(journal, {.timeout = 5.0, .program_timeout = 2.0, .memory = 1e9});
    journal.append(trial(1, Channels()));
    journal.append(trial(2, kTooLong));
    journal.append(trial(3, kProgramTooLong));
    journal.append(trial(4, kNoRoom));
    journal.append(trial(5, kBuckles));
  }
};

using Points = std::vector<double>;

TEST_F(Failed, AllOfThemAreTriedAgainWhereThatIsAskedFor) {
  EXPECT_EQ(counting(journal), (Points{1, 2, 3, 4, 5}));
  EXPECT_EQ(retry_failures(journal), 4);
  EXPECT_EQ(counting(journal), (Points{1}));
  journal.append(trial(2, Channels()));
  journal.append(trial(5, kBuckles));  // the repeated trial counts now
  EXPECT_EQ(counting(journal), (Points{1, 2, 5}));
  EXPECT_EQ(retry_failures(journal), 1);
}

TEST_F(Failed, ARaisedLimitConcernsWhatItForbadeAlone) {
  const auto with = [&](TrialLimits limits) { return retry_what_limits_forbade(journal, limits); };
  EXPECT_EQ(with({5.0, 2.0, 1e9}), 0);
  EXPECT_EQ(with({4.0, 2.0, 1e9}), 0);  // a lowered limit
  EXPECT_EQ(with({9.0, 2.0, 1e9}), 1);
  EXPECT_EQ(counting(journal), (Points{1, 3, 4, 5}));
  EXPECT_EQ(with({9.0, 0.0, 1e9}), 1);  // the new memory limit is none
  EXPECT_EQ(counting(journal), (Points{1, 4, 5}));
  EXPECT_EQ(with({9.0, 0.0, 2e9}), 1);
  EXPECT_EQ(counting(journal), (Points{1, 5}));
}

TEST_F(Failed, WhatIsToBeTriedAgainIsRemembered) {
  EXPECT_EQ(retry_failures(journal), 4);
  journal = Journal::open(folder / "b", kRetriedStudy);  // the assignment closes the first journal
  EXPECT_EQ(counting(Journal::open(folder / "a", kRetriedStudy)), (Points{1}));
}

TEST(RetriedFailures, ASearchAsksForThemAnewAndEndsAsIfTheyHadNeverFailed) {
  const DesignSpace space({{.name = "a", .initial = 0.9}, {.name = "b", .initial = 0.1}});
  bool is_broken = false;
  const Evaluator model = [&](const DesignPoint& p) -> Result<Channels> {
    if (is_broken && p.values[0] < 0.5) return Failure{"no license"};
    Channels channels;
    channels.add({"f", "1", {std::abs(p.values[0] - 0.3) + std::abs(p.values[1] - 0.6)}});
    return channels;
  };
  const Objective target = [](const Channels& c) -> Result<Score> { return Score{c["f"][0]}; };
  const auto search = [&](TrialStore& store) {
    InlineExecutor executor(model);
    Gss gss(space);
    return run_optimizer(gss, target, executor, &store);
  };
  const ScratchFolder folder;
  Journal whole = Journal::open(folder / "whole", kRetriedStudy);
  const auto expected = search(whole);
  Journal journal = Journal::open(folder / "broken", kRetriedStudy);
  is_broken = true;
  TrialsThatCount counting(journal);
  const auto failed = search(counting);
  EXPECT_GT(failed.best()->outcome->value, expected.best()->outcome->value);
  is_broken = false;
  EXPECT_GT(retry_failures(journal), 0);
  const auto again = search(counting);
  ASSERT_EQ(again.steps.size(), expected.steps.size());
  for (std::size_t i = 0; i < again.steps.size(); ++i) {
    EXPECT_EQ(again.steps[i].point, expected.steps[i].point);
  }
}

}  // namespace
}  // namespace latsch
