// SPDX-License-Identifier: Apache-2.0
// Whether this process was started as one of several that are to share the trials of one run, as
// its environment says before MPI is asked:
//
//   OMPI_COMM_WORLD_SIZE    mpirun of Open MPI
//   SLURM_STEP_NUM_TASKS    srun; a batch script has SLURM_NTASKS alone, and is one process
//   PMIX_NAMESPACE          with srun --mpi=pmix: Open MPI makes one job of the tasks
//   PMI_SIZE                another MPI's mpirun, with which Open MPI makes no job
//
// Where nothing makes one job of them, each task would be a master of its own, all on one journal.
// Who sits at a terminal (srun --pty bash) starts one process, whatever the step around it has.
// [Slurm 22.05: srun(1), "OUTPUT ENVIRONMENT VARIABLES"; Open MPI 4.1: mpirun(1)]
#pragma once

#include <functional>
#include <string>

namespace latsch {

struct Launch {
  int tasks = 1;
  int task = 0;         // this one's number
  std::string by;       // "srun"; empty: one process, started by nobody
  bool is_job = false;  // MPI makes one job of them
};

/// `value`: of an environment variable, nullptr where there is none; `at_terminal`: it is read
/// from.
Launch launch_of(const std::function<const char*(const char*)>& value, bool at_terminal = false);
/// Of this process.
Launch launch();

/// Why these tasks cannot share a run, and the commands that work. `study`: as the user named it;
/// `with_mpi`: whether the program knows MPI.
std::string not_one_job(const Launch& launch, const std::string& study, bool with_mpi);

}  // namespace latsch
