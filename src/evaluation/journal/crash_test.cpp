// SPDX-License-Identifier: Apache-2.0
// Kills a real process with real workers and a real journal (kill -9) at random moments and
// restarts it until it ends. No acknowledged trial may be lost or repeated, and the result must
// have the same bits as without a kill.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "base/random.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/executors/inline_executor.h"
#include "evaluation/executors/process_executor.h"
#include "evaluation/executors/worker.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"
#include "evaluation/trial/encoding.h"
#include "optimization/direct_search/gss.h"

namespace latsch {
namespace {

using namespace std::chrono_literals;

constexpr const char* kJournalVariable = "LATSCH_CRASH_TEST_JOURNAL";
const StudyIdentity kCrashStudy{{"model", "two variables"}};

DesignSpace crash_space() {
  return DesignSpace({{.name = "a", .lower = 0.0, .upper = 1.0, .initial = 0.9},
                      {.name = "b", .lower = 0.0, .upper = 1.0, .initial = 0.1}});
}

Result<Channels> model(const DesignPoint& point) {
  Channels channels;
  channels.add({"y", "1", point.values});
  return channels;
}

Result<Score> crash_target(const Channels& channels) {
  const std::vector<double>& y = channels["y"];
  return Score{std::abs(y[0] - 0.3) + std::hypot(y[0] + y[1] - 1.0, 0.1)};
}

std::vector<std::string> this_program(const std::string& test) {
  return {std::filesystem::read_symlink("/proc/self/exe").string(),
          "--gtest_also_run_disabled_tests",
          "--gtest_filter=" + test};
}

// These are the two programs that the test below starts.
TEST(CrashTest, DISABLED_Worker) {
  std::_Exit(serve([](const DesignPoint& point) {
    std::this_thread::sleep_for(3ms);
    return model(point);
  }));
}

TEST(CrashTest, DISABLED_Study) {
  const char* file = std::getenv(kJournalVariable);
  ASSERT_NE(file, nullptr);
  ProcessExecutor executor({.arguments = this_program("CrashTest.DISABLED_Worker"), .workers = 2});
  Journal journal = Journal::open(file, kCrashStudy);
  Gss gss(crash_space());
  (void)run_optimizer(gss, crash_target, executor, &journal);
}

pid_t start_study() {
  const pid_t child = ::fork();
  if (child == 0) {
    std::vector<std::string> arguments = this_program("CrashTest.DISABLED_Study");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    if (!std::freopen("/dev/null", "w", stdout)) std::_Exit(1);
    ::execv(argv[0], argv.data());
    std::_Exit(1);
  }
  return child;
}

/// Returns the number of trials in the journal, which another process writes meanwhile.
long trials_in(const std::filesystem::path& file) {
  try {
    return std::filesystem::exists(file) ? Journal::read(file).size() : 0;
  } catch (const std::exception&) {  // the file is just being created
    return 0;
  }
}

bool has_ended(pid_t child) {
  siginfo_t info{};
  return ::waitid(P_PID, child, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child;
}

/// Runs the study and kills it at the given moment after its journal holds this number of trials.
/// Returns true if the study ended by itself.
bool run_until(const std::filesystem::path& file, long trials, std::chrono::microseconds moment) {
  const pid_t child = start_study();
  while (!has_ended(child) && trials_in(file) < trials) std::this_thread::sleep_for(500us);
  std::this_thread::sleep_for(moment);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(CrashTest, KillAtRandomMomentsLosesAndRepeatsNothing) {
  InlineExecutor inline_executor(model);
  Gss reference_gss(crash_space());
  const auto reference = run_optimizer(reference_gss, crash_target, inline_executor, nullptr);

  const ScratchFolder folder;
  const std::filesystem::path file = folder / "crash.journal";
  ::setenv(kJournalVariable, file.c_str(), 1);
  RandomStream random(3, 0);
  std::vector<Trial> before;
  int kills = 0;
  for (bool ended = false; !ended && kills < 200; kills += !ended) {
    const long more = static_cast<long>(random.below(12));
    const std::chrono::microseconds moment(random.below(5'000));
    ended = run_until(file, std::ssize(before) + more, moment);
    // The process was killed before it created the file.
    if (!std::filesystem::exists(file)) continue;
    const std::vector<Trial> after = Journal::open(file, kCrashStudy).trials();
    ASSERT_GE(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_EQ(after[i].point.bits(), before[i].point.bits());
      ASSERT_EQ(encode(after[i].outcome), encode(before[i].outcome));
    }
    before = after;
  }
  RecordProperty("kills", kills);

  std::set<std::string> points;
  for (const Trial& trial : before) EXPECT_TRUE(points.insert(trial.point.bits()).second);
  Gss gss(crash_space());
  const auto run = replay(gss, crash_target, Journal::read(file));
  EXPECT_EQ(run.end, RunEnd::converged);
  ASSERT_EQ(run.steps.size(), reference.steps.size());
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    EXPECT_EQ(run.steps[i].point.bits(), reference.steps[i].point.bits());
    EXPECT_EQ(run.steps[i].outcome->value, reference.steps[i].outcome->value);
  }
}

}  // namespace
}  // namespace latsch
