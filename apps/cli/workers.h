// SPDX-License-Identifier: Apache-2.0
// Where run, resume, doe and identify evaluate: worker processes of this machine or, below mpirun,
// the ranks of its job.
#pragma once

#include <memory>

#include "correlation/study.h"
#include "evaluation/executor.h"

namespace latsch::cli {

class Workers {
 public:
  Workers();
  /// Below mpirun the other ranks are told to end, also where nothing was ever started.
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// On a rank that works for another one: does so until that ends, then true. False where this
  /// process itself leads the run.
  bool served(const correlation::Study& study);

  /// Of the process that leads the run.
  Executor& start(const correlation::Study& study);

  /// Lets the workers go: what comes now needs none of them.
  void end() { executor_.reset(); }

 private:
  struct Job;
  std::unique_ptr<Job> job_;  // before the executor, which talks through it to its end
  std::unique_ptr<Executor> executor_;
  bool started_ = false;
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
