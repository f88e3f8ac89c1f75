// SPDX-License-Identifier: Apache-2.0
#include "cli/run/workers.h"

#include <cstdint>

#include "base/error.h"
#include "cli/console/console.h"
#include "cli/run/trials.h"
#include "correlation/study/study_stages.h"
#include "evaluation/executors/launch.h"
#include "evaluation/executors/mpi/mpi_executor.h"
#include "evaluation/executors/process_executor.h"
#include "evaluation/trial/encoding.h"

namespace latsch::cli {

namespace {

/// Refuses to run. Only the first of several tasks reports the error: returns true if another task
/// does.
bool refuse(const Launch& launch, const std::string& why) {
  if (launch.task == 0) throw InputError(why);
  be_silent();
  return true;
}

}  // namespace

struct Workers::Job : MpiJob {
  using MpiJob::MpiJob;
};

Workers::Workers(const correlation::Study& study) {
  const Launch started = launch();
  if (started.tasks == 1) return;
  std::string without_mpi;
  if (started.is_job) {
    auto ranks = start_message_passing();
    if (ranks) {
      job_ = std::make_unique<Job>(*std::move(ranks));
    } else {
      without_mpi = ranks.failure().reason;
    }
  }
  if (!job_ || job_->size() != started.tasks) {
    job_.reset();
    refused_ = refuse(started, not_one_job(started, study.file.string(), without_mpi));
  } else if (!job_->agrees(hash(identity_key(study)))) {
    job_.reset();
    refused_ = refuse(started,
                      "the ranks of the job were given different studies, or read different "
                      "versions of one; one study per task: an array of jobs (sbatch --array)");
  }
}

bool Workers::served(const correlation::Study& study, bool in_stages) {
  if (refused_) return true;
  const std::vector<correlation::Study> parts =
      in_stages ? correlation::stages_of(study) : std::vector{study};
  expected_ = static_cast<int>(parts.size());
  if (!job_ || job_->rank() == 0) return false;
  be_silent();
  for (const correlation::Study& part : parts) serve_rank(*job_, worker_processes(part));
  return true;
}

Executor& Workers::start(const correlation::Study& study) {
  end();
  ++started_;
  if (job_) {
    executor_ = std::make_unique<MpiExecutor>(*job_);
  } else {
    executor_ = std::make_unique<ProcessExecutor>(worker_processes(study));
  }
  return *executor_;
}

void Workers::end() {
  executor_.reset();
  if (started_ >= expected_) job_.reset();
}

Workers::~Workers() {
  end();
  if (!job_ || job_->rank() != 0) return;
  for (; started_ < expected_; ++started_) MpiExecutor{*job_};  // the destructor ends the ranks
}

TrialsRun::TrialsRun(Workers& workers, const correlation::Study& study)
    : workers_(workers), study_(study) {
  clear_scratch(study_);
}

TrialsRun::~TrialsRun() {
  workers_.end();
  clear_scratch(study_);
}

}  // namespace latsch::cli
