// SPDX-License-Identifier: Apache-2.0
// Executors run trials: in this process, in its threads, in worker processes, on the ranks of an
// MPI job, or in a simulation with a virtual clock.
//
// An executor runs each requested trial once. The dispatcher, which is the same for all executors,
// decides which points run, in which order, and which are repeated or started twice.
#pragma once

#include <vector>

#include "base/clock.h"
#include "evaluation/trial/trial.h"
#include "optimization/problem/design_point.h"

namespace latsch {

class Executor {
 public:
  virtual ~Executor() = default;

  /// Returns the number of trials that can run at the same time.
  virtual int workers() const = 0;
  /// Returns the number of workers without a trial.
  virtual int idle() const = 0;

  /// Starts the point on an idle worker. Another worker may be running it already.
  virtual void start(const DesignPoint& point) = 0;

  /// Waits at most `patience` seconds until a trial ends, and returns the trials that have ended;
  /// with a patience of 0 it does not wait. If a worker was lost without a fault of its own, its
  /// trial is returned as a failure with Cause::transient, or with Cause::not_begun if no worker
  /// can have tried it; the number of the latter is limited. Never throws because of an evaluation.
  /// Throws InputError if workers cannot be started at all.
  virtual std::vector<Trial> wait(double patience) = 0;

  /// Stops waiting for the running trials of this point and frees their workers as soon as
  /// possible.
  virtual void withdraw(const DesignPoint& point) = 0;
  /// True if withdraw() frees the workers at once.
  virtual bool can_stop() const { return true; }

  /// Stops waiting for all running trials and frees their workers.
  virtual void abandon() = 0;

  /// Returns the time in s on the clock of the trials, which never runs backward.
  virtual double now() const { return steady_clock()(); }
};

}  // namespace latsch
