// SPDX-License-Identifier: Apache-2.0
#include "cli/workers.h"

#include "cli/console.h"
#include "cli/trials.h"
#include "evaluation/process_executor.h"

#ifdef LATSCH_MPI
#include "evaluation/mpi/mpi_executor.h"
#endif

namespace latsch::cli {

#ifdef LATSCH_MPI

struct Workers::Job : MpiJob {};

Workers::Workers() {
  if (MpiJob::is_rank_of_many()) job_ = std::make_unique<Job>();
}

bool Workers::served(const correlation::Study& study) {
  if (!job_ || job_->rank() == 0) return false;
  be_silent();
  serve_rank(*job_, worker_processes(study));
  return true;
}

Executor& Workers::start(const correlation::Study& study) {
  started_ = true;
  if (job_) {
    executor_ = std::make_unique<MpiExecutor>(*job_);
  } else {
    executor_ = std::make_unique<ProcessExecutor>(worker_processes(study));
  }
  return *executor_;
}

Workers::~Workers() {
  if (job_ && job_->rank() == 0 && !started_) MpiExecutor{*job_};  // whose end tells the ranks
}

#else

struct Workers::Job {};

Workers::Workers() = default;

bool Workers::served(const correlation::Study&) { return false; }

Executor& Workers::start(const correlation::Study& study) {
  executor_ = std::make_unique<ProcessExecutor>(worker_processes(study));
  return *executor_;
}

Workers::~Workers() = default;

#endif

TrialsRun::TrialsRun(Workers& workers, const correlation::Study& study)
    : workers_(workers), study_(study) {
  clear_scratch(study_);
}

TrialsRun::~TrialsRun() {
  workers_.end();
  clear_scratch(study_);
}

}  // namespace latsch::cli
