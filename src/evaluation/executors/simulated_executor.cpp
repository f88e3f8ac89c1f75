// SPDX-License-Identifier: Apache-2.0
#include "evaluation/executors/simulated_executor.h"

#include <algorithm>
#include <cassert>

#include "base/random.h"
#include "evaluation/trial/encoding.h"

namespace latsch {

SimulatedExecutor::SimulatedExecutor(Evaluator evaluator, SimulatedOptions options)
    : evaluator_(std::move(evaluator)), options_(options) {
  assert(options_.workers >= 1 && options_.shortest <= options_.longest);
}

void SimulatedExecutor::start(const DesignPoint& point) {
  assert(idle() > 0);
  int worker = 0;
  const auto is_taken = [&](const Running& running) { return running.worker == worker; };
  while (std::any_of(running_.begin(), running_.end(), is_taken)) ++worker;
  RandomStream random(options_.seed, static_cast<std::uint64_t>(started_++));
  const double time = options_.shortest + (options_.longest - options_.shortest) * random.uniform();
  running_.push_back({point, now_, now_ + time, worker});
  busy_time_ += time;
}

std::vector<Trial> SimulatedExecutor::wait(double patience) {
  if (running_.empty()) return {};
  const auto first =
      std::min_element(running_.begin(), running_.end(), [](const Running& a, const Running& b) {
        return a.end < b.end;
      });
  if (patience == 0.0 && first->end > now_) return {};
  const Running ended = *first;
  running_.erase(first);
  now_ = ended.end;
  // The point decides if its trial fails, not the order of events.
  RandomStream lot(options_.seed, hash(ended.point.bits()));
  Outcome outcome = lot.uniform() < options_.failures
                        ? Outcome{.result = Failure{"simulated failure"}}
                        : evaluate(evaluator_, ended.point);
  outcome.wall_time = outcome.cpu_time = ended.end - ended.start;
  outcome.worker = ended.worker;
  return {{ended.point, std::move(outcome)}};
}

void SimulatedExecutor::withdraw(const DesignPoint& point) {
  std::erase_if(running_, [&](const Running& running) { return running.point == point; });
}

}  // namespace latsch
