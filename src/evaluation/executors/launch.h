// SPDX-License-Identifier: Apache-2.0
// Determines from the environment, before MPI starts, if this process is one of several that share
// the trials of one run. The launcher is recognized by these variables:
//
//   OMPI_COMM_WORLD_SIZE    mpirun of Open MPI
//   SLURM_STEP_NUM_TASKS    srun; a batch script has only SLURM_NTASKS, and is one process
//   PMIX_NAMESPACE          srun --mpi=pmix: Open MPI makes one job of the tasks
//   PMI_SIZE                mpirun of another MPI, with which Open MPI makes no job
//
// If nothing joins the tasks into one job, each task would be a master of its own, all on one
// journal. At a terminal (srun --pty bash), a command starts one process, whatever the size of the
// surrounding job step. [Slurm 22.05: srun(1), "OUTPUT ENVIRONMENT VARIABLES"; Open MPI 4.1:
// mpirun(1)]
#pragma once

#include <functional>
#include <string>

namespace latsch {

struct Launch {
  int tasks = 1;
  int task = 0;         // number of this task among all tasks
  std::string by;       // launcher, such as "srun"; empty: a single process without launcher
  bool is_job = false;  // true if MPI joins the tasks into one job
};

/// `value` returns an environment variable, or nullptr if it is not set; `at_terminal` is true if
/// the standard input is a terminal.
Launch launch_of(const std::function<const char*(const char*)>& value, bool at_terminal = false);
/// Returns how this process was launched.
Launch launch();

/// Returns a message that says why these tasks cannot share a run and which commands work. `study`
/// is the name of the study file as the user typed it; `without_mpi` says why MPI cannot be used,
/// and is empty if it can.
std::string not_one_job(const Launch& launch,
                        const std::string& study,
                        const std::string& without_mpi);

}  // namespace latsch
