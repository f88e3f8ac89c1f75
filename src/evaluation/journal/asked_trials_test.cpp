// SPDX-License-Identifier: Apache-2.0
#include "evaluation/journal/asked_trials.h"

#include <gtest/gtest.h>

#include "base/scratch_folder_testing.h"
#include "evaluation/journal/journal.h"

namespace latsch {
namespace {

const StudyIdentity kMarkedStudy{{"model", "x"}};

Trial trial_of_mark(double x) {
  Channels channels;
  channels.add({"y", "1", {x}});
  return {{{x}}, {std::move(channels)}};
}

std::vector<double> asked_of(const Journal& journal) {
  std::vector<double> values;
  journal.for_each_asked([&](const Trial& trial) { values.push_back(trial.point.values[0]); });
  return values;
}

std::set<std::string> points_of_mark(std::initializer_list<double> values) {
  std::set<std::string> all;
  for (const double x : values) all.insert(DesignPoint{{x}}.bits());
  return all;
}

TEST(AskedTrials, OfAJournalWithoutMarksAllCount) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "a", kMarkedStudy);
  journal.append(trial_of_mark(1));
  journal.append(trial_of_mark(2));
  EXPECT_EQ(asked_of(journal), (std::vector<double>{1, 2}));
}

TEST(AskedTrials, SpeculationDoesNotCountUntilItComesTrue) {
  const ScratchFolder folder;
  {
    Journal journal = Journal::open(folder / "a", kMarkedStudy);
    journal.begin_asking();
    for (const double x : {1.0, 2.0, 3.0}) journal.append(trial_of_mark(x));
    EXPECT_EQ(asked_of(journal), (std::vector<double>{1, 2, 3})) << "as long as nobody has ended";
    journal.keep_asked(points_of_mark({1, 3}));
    EXPECT_EQ(asked_of(journal), (std::vector<double>{1, 3}));
  }
  Journal journal = Journal::open(folder / "a", kMarkedStudy);
  EXPECT_EQ(asked_of(journal), (std::vector<double>{1, 3}));
  journal.begin_asking();
  journal.append(trial_of_mark(4));
  journal.keep_asked(points_of_mark({1, 2}));
  EXPECT_EQ(asked_of(journal), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(journal.size(), 4);
}

TEST(AskedTrials, WhatAnOlderProgramLeftCounts) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "a", kMarkedStudy);
  journal.append(trial_of_mark(1));
  journal.begin_asking();
  journal.append(trial_of_mark(2));
  journal.keep_asked({});
  EXPECT_EQ(asked_of(journal), (std::vector<double>{1}));
}

TEST(AskedTrials, WhatSaysNothingNewLeavesNoMark) {
  const ScratchFolder folder;
  Journal journal = Journal::open(folder / "a", kMarkedStudy);
  journal.begin_asking();
  journal.append(trial_of_mark(1));
  journal.keep_asked(points_of_mark({1}));
  const auto marks = journal.marks();
  journal.begin_asking();
  journal.keep_asked(points_of_mark({1}));
  journal.keep_asked({});
  EXPECT_EQ(journal.marks(), marks);
}

}  // namespace
}  // namespace latsch
