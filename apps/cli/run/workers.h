// SPDX-License-Identifier: Apache-2.0
// Executors of run, resume, doe and identify: worker processes of this machine or, under mpirun or
// srun, the ranks of one job. Tasks that do not form a job are refused, because each would lead a
// run of its own on the same journal.
#pragma once

#include <memory>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"

namespace latsch::cli {

class Workers {
 public:
  /// Throws InputError, on the first of several tasks, if the tasks do not form one job or have
  /// different studies.
  explicit Workers(const correlation::Study& study);
  /// Under mpirun this ends the other ranks, even if nothing was ever started.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// On a rank that works for another one: works until that one ends, then returns true. Returns
  /// false if this process itself leads the run. `in_stages` says that the leader starts its
  /// workers stage by stage.
  bool served(const correlation::Study& study, bool in_stages = false);

  /// Starts the executor in the process that leads the run.
  Executor& start(const correlation::Study& study);

  /// Ends the workers: later work does not need them and may take longer than they wait.
  void end();

 private:
  struct Job;
  std::unique_ptr<Job> job_;  // declared before the executor, which uses it until its end
  std::unique_ptr<Executor> executor_;
  int started_ = 0;
  int expected_ = 1;      // number of times the other ranks are started
  bool refused_ = false;  // true if another task reports the refusal
};

/// Trials run during its lifetime. On every kind of end, even a full disk, it ends the workers and
/// then removes the files of killed ones. Must be declared after the journal, which is locked
/// meanwhile.
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
