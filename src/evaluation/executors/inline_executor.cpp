// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/inline_executor.h"

#include <cassert>

namespace latsch {

InlineExecutor::InlineExecutor(Evaluator evaluator) : evaluator_(std::move(evaluator)) {}

void InlineExecutor::start(const DesignPoint& point) {
  assert(!waiting_);
  waiting_ = point;
}

std::vector<Trial> InlineExecutor::wait(double patience) {
  if (!waiting_ || patience == 0.0) return {};
  const DesignPoint point = *std::exchange(waiting_, std::nullopt);
  std::vector<Trial> done;
  // An initializer list of trials would copy the channels.
  done.push_back({point, evaluate(evaluator_, point)});
  return done;
}

void InlineExecutor::withdraw(const DesignPoint& point) {
  if (waiting_ == point) waiting_.reset();
}

void InlineExecutor::abandon() { waiting_.reset(); }

}  // namespace latsch
