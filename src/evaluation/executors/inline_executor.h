// SPDX-License-Identifier: Apache-2.0
// Runs trials one by one in this process. It suits models that cannot hang or crash, and tests.
#pragma once

#include <optional>

#include "evaluation/executors/executor.h"

namespace latsch {

class InlineExecutor : public Executor {
 public:
  /// Evaluates every trial by `evaluator`.
  explicit InlineExecutor(Evaluator evaluator);

  int workers() const override { return 1; }
  int idle() const override { return waiting_ ? 0 : 1; }
  void start(const DesignPoint& point) override;
  std::vector<Trial> wait(double patience) override;
  void withdraw(const DesignPoint& point) override;
  void abandon() override;

 private:
  Evaluator evaluator_;
  std::optional<DesignPoint> waiting_;
};

}  // namespace latsch
