// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/process_executor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "base/error.h"
#include "base/scratch_folder_testing.h"
#include "evaluation/executors/frame.h"
#include "evaluation/executors/worker.h"
#include "evaluation/journal/journal.h"
#include "evaluation/schedule/scheduler.h"
#include "evaluation/trial/encoding.h"

// The address sanitizer would otherwise turn a worker's signal into an exit.
#if defined(__SANITIZE_ADDRESS__)
extern "C" const char* __asan_default_options() { return "handle_segv=0"; }
#endif

namespace latsch {
namespace {

constexpr const char* kOnceVariable = "LATSCH_TEST_FILE";
constexpr const char* kLockVariable = "LATSCH_TEST_LOCK";
constexpr int kLockedFor = 60;  // s, unless killed

enum Fault {
  none,
  segfault,
  abort_,
  hang,
  not_a_number,
  exception,
  exit_code,
  prints_much,
  garbage_answer,
  out_of_memory,
  hanging_child,
  fails,
  stopped_once,
  stopped_always,
  forks,
  answers_twice,
  fills_the_disk,
  hanging_session
};

/// Limits the file size, so that write(2) fails as on a full disk.
void fill_the_disk() {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, 4096};
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::FILE* file = std::tmpfile();
  std::string line(1000, 'x');
  while (std::fputs(line.c_str(), file) >= 0 && std::fflush(file) == 0) {
  }
  throw std::runtime_error(std::strerror(errno));
}

/// An evaluator of two variables: the first one selects a fault, the second one is squared.
Result<Channels> faulty(const DesignPoint& point) {
  const auto fault = static_cast<Fault>(static_cast<int>(point.values[0]));
  switch (fault) {
    case segfault:
      std::raise(SIGSEGV);
      break;
    case abort_:
      std::abort();
    case hang:
      while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    case exception:
      throw std::runtime_error("element 17 is inverted");
    case exit_code:
      std::fputs("cannot go on\n", stderr);
      std::_Exit(7);
    case prints_much:
      for (int i = 0; i < 100'000; ++i) std::puts("a line that a solver prints");
      break;
    case garbage_answer:
      if (::write(kWorkerOutput, "Segmentation fault? No, nonsense.", 33) < 0) std::abort();
      break;
    case out_of_memory: {
      std::vector<std::vector<char>> blocks;
      while (true) blocks.emplace_back(std::size_t{1} << 28, 'x');
    }
    case hanging_child:
      if (::fork() == 0) ::sleep(1000);
      std::raise(SIGSEGV);
      break;
    case hanging_session: {  // the lock is held until both processes have ended
      const int file = ::open(std::getenv(kLockVariable), O_RDWR | O_CREAT, 0600);
      ::flock(file, LOCK_EX);
      if (::fork() == 0) ::setsid();
      ::sleep(kLockedFor);
      break;
    }
    case stopped_once:
      if (std::filesystem::remove(std::getenv(kOnceVariable))) std::raise(SIGTERM);
      break;
    case stopped_always:
      std::raise(SIGTERM);
      break;
    case forks:
      if (::fork() < 0) std::abort();  // both processes continue from here
      break;
    case answers_twice: {
      const std::string old = encode_frame(
          FrameKind::outcome, numbered(0, encode(Outcome{.result = Failure{"an old answer"}})));
      if (::write(kWorkerOutput, old.data(), old.size()) < 0) std::abort();
      break;
    }
    case fills_the_disk:
      fill_the_disk();
      break;
    case fails:
      return Failure{"load step 2: no equilibrium"};
    default:
      break;
  }
  const double x = point.values[1];
  Channels channels;
  const bool is_nan = fault == not_a_number;
  channels.add({"y", "1", {x * x, is_nan ? std::nan("") : 0.0}});
  return channels;
}

// This is the worker program of the tests below, not a test of its own.
TEST(Worker, DISABLED_ServesFaultyEvaluator) { std::_Exit(serve(faulty)); }

ProcessOptions worker_options(int workers) {
  ProcessOptions options;
  options.arguments = {std::filesystem::read_symlink("/proc/self/exe").string(),
                       "--gtest_also_run_disabled_tests",
                       "--gtest_filter=Worker.DISABLED_ServesFaultyEvaluator"};
  options.workers = workers;
  options.timeout = 30.0;
  return options;
}

Trial run_one(ProcessExecutor& executor, const DesignPoint& point) {
  executor.start(point);
  for (int i = 0; i < 1000; ++i) {
    std::vector<Trial> trials = executor.wait(0.1);
    if (!trials.empty()) return trials.front();
  }
  throw std::runtime_error("no outcome in 100 s");
}

std::string reason(ProcessExecutor& executor, Fault fault) {
  const Trial trial = run_one(executor, {{static_cast<double>(fault), 3.0}});
  EXPECT_FALSE(trial.outcome.result.ok()) << fault;
  if (trial.outcome.result) return "";
  // The worker that replaces the lost one works.
  const Trial next = run_one(executor, {{0.0, 4.0}});
  EXPECT_TRUE(next.outcome.result.ok()) << next.outcome.result.failure().reason;
  return trial.outcome.result.failure().reason;
}

void expect_in_output(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(ProcessExecutor, GivesBackChannelsAndTimes) {
  ProcessExecutor executor(worker_options(1));
  const Trial trial = run_one(executor, {{0.0, 3.0}});
  ASSERT_TRUE(trial.outcome.result.ok());
  EXPECT_EQ((*trial.outcome.result)["y"][0], 9.0);
  EXPECT_EQ(trial.point, (DesignPoint{{0.0, 3.0}}));
  EXPECT_GE(trial.outcome.wall_time, 0.0);
}

TEST(ProcessExecutor, EveryFaultIsAFailureWithItsReason) {
  ProcessOptions options = worker_options(1);
  // The shadow memory of the address sanitizer needs terabytes of address space.
#if !defined(__SANITIZE_ADDRESS__)
  options.memory_limit = 1e9;
#endif
  ProcessExecutor executor(options);
  expect_in_output(reason(executor, segfault), "killed by signal 11");
  expect_in_output(reason(executor, abort_), "killed by signal 6");
  expect_in_output(reason(executor, not_a_number), "channel \"y\" is nan at sample 2");
  expect_in_output(reason(executor, exception), "element 17 is inverted");
  const std::string exited = reason(executor, exit_code);
  expect_in_output(exited, "exited with code 7");
  expect_in_output(exited, "it last printed \"cannot go on\"");
  expect_in_output(reason(executor, garbage_answer), "not readable");
  expect_in_output(reason(executor, hanging_child), "killed by signal 11");
  expect_in_output(reason(executor, fails), "load step 2");
#if !defined(__SANITIZE_ADDRESS__)
  expect_in_output(reason(executor, out_of_memory), "out of memory");
#endif
}

TEST(ProcessExecutor, ATrialWhoseWorkerIsStoppedFromOutsideIsRepeated) {
  const ScratchFolder folder;
  std::ofstream(folder / "once") << "x";
  ::setenv(kOnceVariable, (folder / "once").c_str(), 1);
  ProcessExecutor executor(worker_options(1));
  Journal journal = Journal::open(folder / "j", {});
  const SamplingPlan plan{
      {{{static_cast<double>(stopped_once), 3.0}}, {{static_cast<double>(stopped_always), 3.0}}}};
  EXPECT_EQ(run_doe(plan, executor, journal), RunEnd::converged);
  EXPECT_FALSE(std::filesystem::exists(folder / "once"));
  const std::vector<Trial> trials = journal.trials();
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_TRUE(trials[0].outcome.result.ok());
  const Failure failure = trials[1].outcome.result.failure();
  EXPECT_EQ(failure.cause, Cause::transient);
  expect_in_output(failure.reason, "killed by signal 15");
  expect_in_output(failure.reason, "attempt 2 of 2");
}

TEST(ProcessExecutor, AnEvaluatorThatForksAnswersOnce) {
  ProcessExecutor executor(worker_options(1));
  for (int i = 0; i < 20; ++i) {
    const Trial trial = run_one(executor, {{static_cast<double>(forks), 1.0 * i}});
    ASSERT_TRUE(trial.outcome.result.ok()) << trial.outcome.result.failure().reason;
    EXPECT_EQ((*trial.outcome.result)["y"][0], 1.0 * i * i);
  }
}

// A worker's late answer for an earlier trial must not count as the answer for the next trial.
TEST(ProcessExecutor, AnAnswerToAnotherTrialIsRefused) {
  ProcessExecutor executor(worker_options(1));
  const Trial trial = run_one(executor, {{static_cast<double>(answers_twice), 3.0}});
  ASSERT_FALSE(trial.outcome.result.ok());
  EXPECT_EQ(trial.outcome.result.failure().cause, Cause::bad_output);
}

TEST(ProcessExecutor, AFullDiskIsAFailureOfTheTrialAlone) {
  ProcessExecutor executor(worker_options(1));
  expect_in_output(reason(executor, fills_the_disk), "File too large");
}

TEST(ProcessExecutor, WhatAWorkerPrintsDoesNotDisturbItsAnswer) {
  ProcessExecutor executor(worker_options(1));
  const Trial trial = run_one(executor, {{static_cast<double>(prints_much), 3.0}});
  ASSERT_TRUE(trial.outcome.result.ok());
  EXPECT_EQ((*trial.outcome.result)["y"][0], 9.0);
}

TEST(ProcessExecutor, AHangingTrialIsKilledAtMostASecondAfterItsTimeout) {
  ProcessOptions options = worker_options(1);
  options.timeout = 0.5;
  ProcessExecutor executor(options);
  const Trial trial = run_one(executor, {{static_cast<double>(hang), 3.0}});
  ASSERT_FALSE(trial.outcome.result.ok());
  expect_in_output(trial.outcome.result.failure().reason, "took more than the 0.5 s allowed");
  EXPECT_GE(trial.outcome.wall_time, 0.5);
  EXPECT_LT(trial.outcome.wall_time, 1.5);
}

TEST(ProcessExecutor, AChildThatLeftTheProcessGroupIsKilledWithTheTrial) {
  const ScratchFolder folder;
  const auto lock = folder / "lock";
  ::setenv(kLockVariable, lock.c_str(), 1);
  ProcessOptions options = worker_options(1);
  options.timeout = 0.5;
  ProcessExecutor executor(options);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(run_one(executor, {{static_cast<double>(hanging_session), 3.0}}).outcome.result);
  const int file = ::open(lock.c_str(), O_RDWR);
  ASSERT_GE(file, 0);
  ASSERT_EQ(::flock(file, LOCK_EX), 0);
  ::close(file);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(kLockedFor / 2));
}

TEST(ProcessExecutor, WorkersWorkAtTheSameTime) {
  ProcessOptions options = worker_options(3);
  options.timeout = 1.0;
  ProcessExecutor executor(options);
  executor.start({{static_cast<double>(hang), 1.0}});
  executor.start({{0.0, 5.0}});
  EXPECT_EQ(executor.idle(), 1);
  std::vector<Trial> trials;
  while (trials.empty()) trials = executor.wait(0.1);
  ASSERT_TRUE(trials.front().outcome.result.ok());
  EXPECT_EQ((*trials.front().outcome.result)["y"][0], 25.0);
  executor.abandon();
  EXPECT_EQ(executor.idle(), 3);
  EXPECT_TRUE(executor.wait(0.05).empty());
}

/// Returns options for a worker whose first `times` processes are killed before they are ready.
ProcessOptions killed_while_it_starts(const ScratchFolder& folder, int times) {
  ProcessOptions options = worker_options(1);
  const std::string script =
      fmt::format(R"(echo >> "{0}"; [ $(wc -l < "{0}") -gt {1} ] || kill -9 $$; exec "$0" "$@")",
                  (folder / "starts").string(),
                  times);
  options.arguments.insert(options.arguments.begin(), {"/bin/sh", "-c", script});
  return options;
}

// If a system lacks memory, or an administrator ends processes, workers die while they start,
// several times in a row. This does not prove a fault of the program.
TEST(ProcessExecutor, AWorkerThatIsKilledWhileItStartsIsStartedAgain) {
  const ScratchFolder folder;
  ProcessExecutor executor(killed_while_it_starts(folder, 6));
  const Trial trial = run_one(executor, {{0.0, 3.0}});
  ASSERT_TRUE(trial.outcome.result) << trial.outcome.result.failure().reason;
  EXPECT_EQ((*trial.outcome.result)["y"][0], 9.0);
}

TEST(ProcessExecutor, WorkersThatAreAlwaysKilledWhileTheyStartEndTheRun) {
  const ScratchFolder folder;
  ProcessExecutor executor(killed_while_it_starts(folder, 1000));
  try {
    run_one(executor, {{0.0, 3.0}});
    FAIL() << "no error";
  } catch (const InputError& error) {
    expect_in_output(error.what(),
                     "(Killed) before it was ready, 20 times in a row; is there too little memory");
  }
}

/// Returns options for a worker that first executes `script`, a line for the shell. `limit` is the
/// limit of its start, s.
ProcessOptions slow_to_start(const std::string& script, double limit) {
  ProcessOptions options = worker_options(1);
  options.arguments.insert(options.arguments.begin(),
                           {"/bin/sh", "-c", script + R"(; exec "$0" "$@")"});
  options.start_timeout = limit;
  return options;
}

std::string complaint_of_start(const std::string& script) {
  try {
    ProcessExecutor executor(slow_to_start(script, 0.3));
    run_one(executor, {{0.0, 3.0}});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// While this object exists, its thread and all processes that it starts may use only one
/// processor, which nine other threads keep busy.
class BusyProcessor {
 public:
  BusyProcessor() {
    ::sched_getaffinity(0, sizeof(before_), &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(::sched_getcpu(), &one);
    ::sched_setaffinity(0, sizeof(one), &one);  // threads and processes started now inherit it
    for (std::thread& thread : busy_)
      thread = std::thread([this] {
        while (!ends_) {
        }
      });
  }
  ~BusyProcessor() {
    ends_ = true;
    for (std::thread& thread : busy_) thread.join();
    ::sched_setaffinity(0, sizeof(before_), &before_);
  }

 private:
  cpu_set_t before_{};
  std::atomic<bool> ends_ = false;
  std::array<std::thread, 9> busy_;
};

// The worker gets a tenth of a processor at most, so that its start, which needs some 0.1 s of a
// processor, takes longer than the limit.
TEST(ProcessExecutor, AWorkerThatWaitsForAProcessorIsNotLost) {
  const BusyProcessor busy;
  const auto begin = std::chrono::steady_clock::now();
  ProcessExecutor executor(slow_to_start("i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done", 0.5));
  const Trial trial = run_one(executor, {{0.0, 3.0}});
  ASSERT_TRUE(trial.outcome.result) << trial.outcome.result.failure().reason;
  EXPECT_EQ((*trial.outcome.result)["y"][0], 9.0);
  EXPECT_GT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(500));
}

TEST(ProcessExecutor, AWorkerThatNeitherComputesNorWaitsForAProcessorIsLost) {
  expect_in_output(complaint_of_start("sleep 100"),
                   "neither computed nor waited for a processor or a disk for more than 0.3 s "
                   "before it was ready, 3 times in a row");
}

TEST(ProcessExecutor, AWorkerThatComputesForEverBeforeItIsReadyIsLost) {
  expect_in_output(complaint_of_start("while :; do :; done"),
                   "used more than 0.3 s of processor time before it was ready");
}

TEST(ProcessExecutor, AProgramThatIsNoWorkerIsReportedInWords) {
  ProcessOptions options = worker_options(1);
  options.arguments = {"/no/such/program"};
  EXPECT_THROW(ProcessExecutor(options).start({{0.0, 1.0}}), InputError);
  options.arguments = {"/bin/sh", "-c", "echo wrong study >&2; exit 2"};
  ProcessExecutor executor(options);
  try {
    run_one(executor, {{0.0, 1.0}});
    FAIL() << "no error";
  } catch (const InputError& error) {
    expect_in_output(error.what(), "exited with code 2; it last printed \"wrong study\"");
  }
  EXPECT_THROW(ProcessExecutor(ProcessOptions{}), InputError);
}

}  // namespace
}  // namespace latsch
