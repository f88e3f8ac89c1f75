// SPDX-License-Identifier: Apache-2.0
// Worker processes: a trial that crashes, hangs or prints nonsense loses only that trial.
//
// Each worker is a program started from an argument list (never a shell line) by posix_spawn, in
// its own process group, and calls serve() of worker.h. The worker answers on separate file
// descriptors; its printed output is kept as a reason for failures. A worker that exceeds the
// timeout is killed with its whole process group and replaced.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "evaluation/executors/executor.h"

namespace latsch {

/// The worker processes and the limits of their trials.
struct ProcessOptions {
  std::vector<std::string> arguments;  // the worker's program and its arguments
  int workers = 1;                     // number of worker processes
  double timeout = 600.0;              // limit of the wall time of one trial, s
  /// Limit for the start of a worker, s. The worker is ended if it has used this much processor
  /// time before it is ready, or if for this long it has neither computed nor waited for a
  /// processor or a disk. On a machine with many other processes a start may take up to twenty
  /// times as long.
  double start_timeout = 60.0;
  double memory_limit = 0.0;  // address space of each worker, bytes; 0: unlimited
};

class ProcessExecutor : public Executor {
 public:
  /// Starts the workers. Throws InputError if the program cannot be started.
  explicit ProcessExecutor(ProcessOptions options);
  ~ProcessExecutor() override;

  int workers() const override;
  int idle() const override;
  /// Returns the number of running trials whose worker was ready for them.
  int begun() const;
  void start(const DesignPoint& point) override;
  std::vector<Trial> wait(double patience) override;
  void withdraw(const DesignPoint& point) override;
  void abandon() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace latsch
