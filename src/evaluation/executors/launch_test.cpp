// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/launch.h"

#include <gtest/gtest.h>

#include <map>
#include <string_view>

namespace latsch {
namespace {

using Environment = std::map<std::string, std::string>;

Launch of(const Environment& environment) {
  return launch_of([&](const char* name) -> const char* {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  });
}

// The variables are those printed by env in Slurm 22.05 and Open MPI 4.1 of Debian 12; ./bench.sh
// slurm runs there.
TEST(Launch, IsReadFromTheEnvironment) {
  const Launch alone = of({});
  EXPECT_EQ(alone.tasks, 1);
  EXPECT_FALSE(alone.is_job);

  const Launch mpirun = of({{"OMPI_COMM_WORLD_SIZE", "4"}, {"OMPI_COMM_WORLD_RANK", "2"}});
  EXPECT_EQ(mpirun.tasks, 4);
  EXPECT_EQ(mpirun.task, 2);
  EXPECT_TRUE(mpirun.is_job);

  Environment step{{"SLURM_STEP_NUM_TASKS", "3"}, {"SLURM_NTASKS", "3"}, {"SLURM_PROCID", "1"}};
  EXPECT_EQ(of(step).tasks, 3);
  EXPECT_EQ(of(step).task, 1);
  EXPECT_FALSE(of(step).is_job);  // --mpi=none
  step.insert({{"PMI_SIZE", "3"}, {"PMI_RANK", "1"}, {"PMI_FD", "13"}});
  EXPECT_FALSE(of(step).is_job);  // --mpi=pmi2
  step.insert({{"PMIX_NAMESPACE", "slurm.pmix.3.0"}, {"PMIX_RANK", "1"}});
  EXPECT_TRUE(of(step).is_job);  // --mpi=pmix
}

// SLURM_NTASKS is the number of tasks of the job. A batch script runs only once, whatever this
// number.
TEST(Launch, AScriptOfABatchJobIsOneProcess) {
  const Launch script = of({{"SLURM_NTASKS", "3"}, {"SLURM_NPROCS", "3"}, {"SLURM_PROCID", "0"}});
  EXPECT_EQ(script.tasks, 1);
  EXPECT_FALSE(script.is_job);
}

// If latsch run is started in the shell of srun -n 8 --pty bash, it is a single process. MPI would
// wait for seven others that never come.
TEST(Launch, WhoSitsAtATerminalStartsOneProcess) {
  const auto value = [](const char* name) -> const char* {
    return std::string_view(name) == "SLURM_STEP_NUM_TASKS" ? "8" : "0";
  };
  EXPECT_EQ(launch_of(value, true).tasks, 1);
  EXPECT_EQ(launch_of(value, false).tasks, 8);
}

TEST(Launch, AnOrteOnANodeOfSlurmIsMpiruns) {
  const Launch rank = of({{"OMPI_COMM_WORLD_SIZE", "4"},
                          {"OMPI_COMM_WORLD_RANK", "3"},
                          {"SLURM_STEP_NUM_TASKS", "2"},
                          {"SLURM_PROCID", "1"}});
  EXPECT_EQ(rank.tasks, 4);
  EXPECT_EQ(rank.task, 3);
  EXPECT_EQ(rank.by, "mpirun");
}

TEST(Launch, AnotherMpiMakesNoJobOfThem) {
  const Launch hydra = of({{"PMI_SIZE", "2"}, {"PMI_RANK", "1"}});
  EXPECT_EQ(hydra.tasks, 2);
  EXPECT_EQ(hydra.task, 1);
  EXPECT_FALSE(hydra.is_job);
}

TEST(Launch, WhatWorksIsNamed) {
  const Launch launch{3, 0, "srun", false};
  const std::string text = not_one_job(launch, "s.toml", "");
  EXPECT_NE(text.find("3 tasks were started by srun"), std::string::npos);
  EXPECT_NE(text.find("srun --mpi=pmix latsch run s.toml"), std::string::npos);
  const std::string without = not_one_job(launch, "s.toml", "it is not there");
  EXPECT_EQ(without.find("pmix"), std::string::npos);
  EXPECT_NE(without.find("because it is not there"), std::string::npos);
}

}  // namespace
}  // namespace latsch
