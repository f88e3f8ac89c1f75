// SPDX-License-Identifier: Apache-2.0
// Executors of run, resume, doe and identify: worker processes of this machine or, under mpirun or
// srun, the ranks of one job. Several tasks that do not form a job are refused, because each would
// run the same study on the same journal.
#pragma once

#include <memory>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"

namespace latsch::cli {

class Workers {
 public:
  /// Throws InputError, on the first of several tasks, if the tasks do not form one job or read
  /// different studies.
  explicit Workers(const correlation::Study& study);
  /// Under mpirun the destructor ends the other ranks, even if no trial was started.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// On a rank that works for the leader: computes trials until the leader ends, then returns true.
  /// In the process that leads the run: returns false at once. `in_stages` says that the leader
  /// starts its workers anew for each stage.
  bool served(const correlation::Study& study, bool in_stages = false);

  /// Starts the executor in the process that leads the run.
  Executor& start(const correlation::Study& study);

  /// Ends the workers. Called before long work that does not need them, because they would give up
  /// waiting.
  void end();

 private:
  struct Job;
  std::unique_ptr<Job> job_;  // declared before the executor, which uses it until its end
  std::unique_ptr<Executor> executor_;
  int started_ = 0;
  int expected_ = 1;      // number of times that the leader starts the other ranks
  bool refused_ = false;  // true if another task reports the refusal
};

/// Scope in which the trials of a study run. At every kind of end, even with a full disk, its
/// destructor ends the workers and then removes the files of killed ones. It must be declared after
/// the journal, which has to be locked meanwhile.
class TrialsRun {
 public:
  TrialsRun(Workers& workers, const correlation::Study& study);
  ~TrialsRun();
  TrialsRun(const TrialsRun&) = delete;
  TrialsRun& operator=(const TrialsRun&) = delete;

 private:
  Workers& workers_;
  const correlation::Study& study_;
};

}  // namespace latsch::cli
