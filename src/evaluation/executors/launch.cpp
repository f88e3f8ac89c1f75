// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/launch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <cstring>

namespace latsch {
namespace {

using Value = std::function<const char*(const char*)>;

/// Returns an environment variable as an integer, or `otherwise` if it is not set or is no number.
int number(const Value& value, const char* name, int otherwise) {
  const char* text = value(name);
  int result = otherwise;
  if (text) std::from_chars(text, text + std::strlen(text), result);
  return result;
}

}  // namespace

Launch launch_of(const Value& value, bool at_terminal) {
  if (const int tasks = number(value, "OMPI_COMM_WORLD_SIZE", 0)) {
    return {tasks, number(value, "OMPI_COMM_WORLD_RANK", 0), "mpirun", tasks > 1};
  }
  if (at_terminal) return {};
  if (const int tasks = number(value, "SLURM_STEP_NUM_TASKS", 0)) {
    const bool joined = value("PMIX_NAMESPACE") && value("PMIX_RANK");
    return {tasks, number(value, "SLURM_PROCID", 0), "srun", tasks > 1 && joined};
  }
  if (const int tasks = number(value, "PMI_SIZE", 0)) {
    return {tasks, number(value, "PMI_RANK", 0), "the mpirun of another MPI", false};
  }
  return {};
}

Launch launch() {
  return launch_of([](const char* name) -> const char* { return std::getenv(name); },
                   ::isatty(STDIN_FILENO) == 1);
}

std::string not_one_job(const Launch& launch,
                        const std::string& study,
                        const std::string& without_mpi) {
  const std::string began = fmt::format("{} tasks were started by {}, ", launch.tasks, launch.by);
  const std::string alone = fmt::format(
      "one process alone, with workers of its own: latsch run {}; one study per task: an array "
      "of jobs "
      "(sbatch --array). No journal was touched",
      study);
  if (!without_mpi.empty()) {
    return began + "and MPI, which would make one job of them, cannot be used, because " +
           without_mpi + ". What works: " + alone;
  }
  return began + fmt::format(
                     "and nothing makes one job of them: Open MPI needs PMIx for that. What works: "
                     "srun --mpi=pmix latsch run {0} (srun --mpi=list says whether Slurm has it); "
                     "mpirun latsch run {0}; {1}",
                     study,
                     alone);
}

}  // namespace latsch
