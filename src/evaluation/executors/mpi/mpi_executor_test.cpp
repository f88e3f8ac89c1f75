// SPDX-License-Identifier: Apache-2.0
// Tests working ranks whose master is busy with other work, with short time limits:
//
//   mpirun -n 3 mpi_executor_test         rank 0 tests, the others work
#include "evaluation/executors/mpi/mpi_executor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "evaluation/executors/worker.h"
#include "evaluation/schedule/scheduler.h"

namespace latsch {
namespace {

constexpr MpiPatience kLittle{.heartbeat = 0.05, .silence = 0.6, .master_silence = 0.8};
constexpr auto kBusy = std::chrono::milliseconds(2000);

MpiJob* the_job = nullptr;  // one job for all tests, because MPI can start only once in a process

Result<Channels> square(const DesignPoint& point) {
  Channels channels;
  channels.add({"y", "1", {point.values[0] * point.values[0]}});
  return channels;
}

/// Sends one point to every rank and expects that all of them return its outcome.
void expect_answers(MpiExecutor& executor, double first) {
  const int ranks = executor.workers();
  for (int i = 0; i < ranks; ++i) executor.start({{first + i}});
  std::vector<Trial> trials;
  for (int i = 0; i < 100 && std::ssize(trials) < ranks; ++i) {
    for (Trial& trial : executor.wait(0.1)) trials.push_back(std::move(trial));
  }
  ASSERT_EQ(std::ssize(trials), ranks);
  for (const Trial& trial : trials) {
    ASSERT_TRUE(trial.outcome.result) << trial.outcome.result.failure().reason;
    EXPECT_EQ(*trial.outcome.result, *square(trial.point));
  }
}

// The master is busy, for example with reading a large journal, computing a long step or writing a
// page. The ranks wait, and the master does not count its own absence as their silence.
TEST(MpiExecutor, RanksStayWhileTheMasterIsBusy) {
  std::this_thread::sleep_for(kBusy);
  {
    MpiExecutor executor(*the_job);
    expect_answers(executor, 1.0);
    std::this_thread::sleep_for(kBusy);
    expect_answers(executor, 10.0);
    executor.start({{100.0}});
    std::this_thread::sleep_for(kBusy);  // the answer arrives during this time
    const std::vector<Trial> trials = executor.wait(1.0);
    ASSERT_EQ(trials.size(), 1u);
    EXPECT_TRUE(trials[0].outcome.result.ok());
  }
  EXPECT_FALSE(the_job->is_alone());  // every rank has ended its work
}

}  // namespace
}  // namespace latsch

int main(int argc, char** argv) {
  using namespace latsch;
  if (argc > 1 && std::strcmp(argv[1], "worker") == 0) return serve(square);
  testing::InitGoogleTest(&argc, argv);
  auto ranks = start_message_passing();
  if (!ranks) {
    std::fputs((ranks.failure().reason + "\n").c_str(), stderr);
    return 1;
  }
  MpiJob job(*std::move(ranks), kLittle);
  if (job.rank() > 0) {
    ProcessOptions options;
    options.arguments = {std::filesystem::read_symlink("/proc/self/exe").string(), "worker"};
    serve_rank(job, options);
    return 0;
  }
  the_job = &job;
  return RUN_ALL_TESTS();
}
