// SPDX-License-Identifier: Apache-2.0
// Where trials run: in this process, in its threads, in worker processes, on the ranks of an MPI
// job, or in a simulated world with a clock of its own.
//
// An executor runs what it is told to, once. Which points, in which order, what is tried again or
// started twice is decided by the dispatcher, the same for all of them.
#pragma once

#include <vector>

#include "base/clock.h"
#include "evaluation/trial/trial.h"
#include "optimization/problem/design_point.h"

namespace latsch {

class Executor {
 public:
  virtual ~Executor() = default;

  virtual int workers() const = 0;
  /// Workers without a trial.
  virtual int idle() const = 0;

  /// Hands the point to an idle worker. It may run on another one already.
  virtual void start(const DesignPoint& point) = 0;

  /// Waits until a trial ends, at most `patience` seconds, and returns those that did; with a
  /// patience of 0 those that have ended already. A trial whose worker was lost without a fault of
  /// its own is a failure with Cause::transient, or with Cause::not_begun where no worker can have
  /// tried it; of the latter there is an end. Never throws for what an evaluation did; throws
  /// InputError where workers cannot be started at all.
  virtual std::vector<Trial> wait(double patience) = 0;

  /// Forgets the running trials of this point and frees their workers as soon as it can.
  virtual void withdraw(const DesignPoint& point) = 0;
  /// Whether that frees them at once.
  virtual bool can_stop() const { return true; }

  /// Forgets all running trials and frees their workers.
  virtual void abandon() = 0;

  /// s on the clock by which trials run; never runs backward.
  virtual double now() const { return steady_clock()(); }
};

}  // namespace latsch
