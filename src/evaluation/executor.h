// SPDX-License-Identifier: Apache-2.0
// Where trials run: in this process, in worker processes, or in a simulated world with a clock of
// its own.
#pragma once

#include <vector>

#include "evaluation/trial.h"
#include "optimization/design_point.h"

namespace latsch {

class Executor {
 public:
  virtual ~Executor() = default;

  virtual int workers() const = 0;
  /// Workers without a trial.
  virtual int idle() const = 0;

  /// Hands the point to an idle worker.
  virtual void start(const DesignPoint& point) = 0;

  /// Waits until a trial ends, at most `patience` seconds, and returns those that did. Never throws
  /// for what an evaluation did; throws InputError where workers cannot be started at all.
  virtual std::vector<Trial> wait(double patience) = 0;

  /// Forgets running trials and frees their workers at once.
  virtual void abandon() = 0;
};

}  // namespace latsch
