// SPDX-License-Identifier: Apache-2.0
// Where run, resume, doe and identify evaluate: worker processes of this machine or, below mpirun
// or srun, the ranks of one job. Tasks that are no job are refused: each would lead a run of its
// own on the same journal.
#pragma once

#include <memory>

#include "correlation/study/study.h"
#include "evaluation/executors/executor.h"

namespace latsch::cli {

class Workers {
 public:
  /// Throws InputError, on the first of several tasks, where nothing makes one job of them or they
  /// were given different studies.
  explicit Workers(const correlation::Study& study);
  /// Below mpirun the other ranks are told to end, also where nothing was ever started.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// On a rank that works for another one: does so until that ends, then true. False where this
  /// process itself leads the run.
  /// `in_stages`: where the leader starts its workers stage by stage.
  bool served(const correlation::Study& study, bool in_stages = false);

  /// Of the process that leads the run.
  Executor& start(const correlation::Study& study);

  /// Lets the workers go: what comes now needs none of them, and may take longer than they wait.
  void end();

 private:
  struct Job;
  std::unique_ptr<Job> job_;  // before the executor, which talks through it to its end
  std::unique_ptr<Executor> executor_;
  int started_ = 0;
  int expected_ = 1;      // how often the other ranks are started
  bool refused_ = false;  // and another task says so
};

/// In its lifetime trials are run. However it ends, a full disk among them, the workers go and then
/// what killed ones left behind. Declared after the journal, which is held meanwhile.
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
