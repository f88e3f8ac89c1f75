// SPDX-License-Identifier: Apache-2.0
#include "correlation/study/run_settings.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace latsch::correlation {
namespace {

RunSettings run_settings_of(const std::string& text) {
  const Document document = Document::parse(text, "study.toml");
  const Node root = document.root();
  const RunSettings settings = read_run_settings(&root, "folder/study.toml");
  root.close();
  return settings;
}

std::string run_complaint(const std::string& text) {
  try {
    run_settings_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunSettings, WithoutATableOneWorkerRunsTenMinutesATrialAndGoesOnAfterFailures) {
  const RunSettings run = read_run_settings(nullptr, "folder/study.toml");
  EXPECT_EQ(run.workers, 1);
  EXPECT_EQ(run.timeout, 600.0);
  EXPECT_EQ(run.memory, 0.0);
  EXPECT_EQ(run.on_failure.then, FailurePolicy::Then::proceed);
  EXPECT_EQ(run.on_failure.retries, 0);
  EXPECT_EQ(run.journal, "folder/study.latsch");
  EXPECT_EQ(run.straggler_factor, 3.0);
  EXPECT_EQ(run.look_ahead, 4);
}

TEST(RunSettings, AreReadWithTheirUnits) {
  const RunSettings run = run_settings_of(
      "workers = 3\ntimeout = \"2 min\"\nmemory = \"4 GB\"\n"
      "on_failure = \"retry\"\nretries = 2\njournal = \"a.latsch\"\n");
  EXPECT_EQ(run.workers, 3);
  EXPECT_EQ(run.timeout, 120.0);
  EXPECT_EQ(run.memory, 4e9);
  EXPECT_EQ(run.on_failure.retries, 2);
  EXPECT_EQ(run.journal, "folder/a.latsch");
  EXPECT_EQ(run_settings_of("on_failure = \"abort\"").on_failure.then, FailurePolicy::Then::abort);
}

TEST(RunSettings, AFailedPointIsAnsweredByAPenaltyOrApproached) {
  const FailurePolicy penalty =
      run_settings_of("on_failure = \"recover\"\npenalty = \"250 %\"").on_failure;
  EXPECT_EQ(penalty.then, FailurePolicy::Then::recover);
  EXPECT_DOUBLE_EQ(penalty.penalty, 2.5);
  EXPECT_EQ(in_words(penalty), "it counts as a target of 250 %");
  const FailurePolicy halvings =
      run_settings_of("on_failure = \"continuation\"\nhalvings = 6").on_failure;
  EXPECT_EQ(halvings.then, FailurePolicy::Then::continuation);
  EXPECT_EQ(halvings.halvings, 6);
  EXPECT_NE(in_words(halvings).find("6 halvings"), std::string::npos);
}

TEST(RunSettings, StragglersAndLookAheadAreTheUsers) {
  const RunSettings run = run_settings_of("straggler_factor = 1.5\nlook_ahead = 9\n");
  EXPECT_EQ(run.straggler_factor, 1.5);
  EXPECT_EQ(run.look_ahead, 9);
  EXPECT_EQ(run_settings_of("stragglers = true").straggler_factor, 3.0);
  EXPECT_EQ(run_settings_of("stragglers = false").straggler_factor, 0.0);
}

TEST(RunSettings, WhatMakesNoSenseIsRefusedInWords) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(run_complaint(text).find(part), std::string::npos) << run_complaint(text);
  };
  says("memory = \"4 parsec\"", "expected an amount of at least 16 MB such as \"4 GB\"");
  says("memory = \"1 kB\"", "at least 16 MB");
  says("memory = \"-4 GB\"", "expected an amount");
  says("on_failure = \"recover!\"", "\"retry\", \"recover\" or \"continuation\"");
  says("retries = 2", "without on_failure = \"retry\"");
  says("on_failure = \"retry\"\npenalty = 2", "without on_failure = \"recover\"");
  says("on_failure = \"recover\"\nhalvings = 2", "without on_failure = \"continuation\"");
  says("on_failure = \"recover\"\npenalty = -1", "penalty");
  says("on_failure = \"continuation\"\nhalvings = 0", "halvings");
  says("straggler_factor = 0.5", "straggler_factor");
  says("stragglers = false\nstraggler_factor = 3", "is given beside stragglers = false");
  says("look_ahead = 0", "look_ahead");
  says("lookahead = 2", "lookahead");
}

TEST(RunSettings, AJournalThatCannotBeKeptIsRefusedBeforeTheFirstTrial) {
  EXPECT_NE(run_complaint("journal = \"\"").find("is empty"), std::string::npos);
  EXPECT_NE(run_complaint("journal = \"/\"").find("is a folder"), std::string::npos);
  EXPECT_NE(run_complaint("journal = \"/dev/null\"").find("is a device"), std::string::npos);
  EXPECT_NE(run_complaint("journal = \"nowhere/a.latsch\"").find("folder/nowhere"),
            std::string::npos);
}

TEST(RunSettings, MemoryIsCountedInPowersOfAThousand) {
  EXPECT_EQ(parse_memory("64 kB"), 64e3);
  EXPECT_EQ(parse_memory("0.5 TB"), 0.5e12);
  EXPECT_FALSE(parse_memory("4"));
  EXPECT_FALSE(parse_memory("GB"));
}

}  // namespace
}  // namespace latsch::correlation
