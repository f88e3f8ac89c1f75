// SPDX-License-Identifier: Apache-2.0
// Records the extremes of the inputs that a rolling tire passes to the Magic Formula, and reports
// which ranges of its file they leave. The formula clamps its inputs to these ranges, so beyond
// them its forces are those at the limit. A report of them warns the user.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "models/magic_formula/magic_formula.h"

namespace latsch::magic_formula {

struct Extremes {
  double from = INFINITY, to = -INFINITY;
  void add(double value) {
    from = std::min(from, value);
    to = std::max(to, value);
  }
  void add(const Extremes& other) {
    from = std::min(from, other.from);
    to = std::max(to, other.to);
  }
};

struct InputExtremes {
  Extremes Fz, kappa, alpha, gamma, p, speed;  // SI units; `speed` is |Vx|
  Extremes standing;                           // N, loads of a standing tire

  void add(const State& state);
  void add(const InputExtremes& other);
};

/// Returns one sentence for every range of the file that was left, and one for a load beyond its
/// [DEFLECTION_LOAD_CURVE]; empty if there are none. A load below FZMIN or a speed below VXLOW is
/// reported only if it never exceeds this limit, because a tire may lift off and start from rest.
std::vector<std::string> ranges_left(const InputExtremes& inputs, const Parameters& parameters);

/// Collects the extremes of the inputs of several tires. It may be used by several threads.
class RangeLog {
 public:
  void add(const State& state);
  void add_standing(double load);
  void add(const InputExtremes& inputs);
  InputExtremes inputs() const;

 private:
  mutable std::mutex mutex_;
  InputExtremes inputs_;
};

/// Member of a tire that records the tire's inputs and is copied with the tire's state. Its
/// destructor passes the inputs to the log. If a step is rejected, the tire is overwritten by its
/// former state, so the inputs of this step are not counted.
class RangeWatch {
 public:
  explicit RangeWatch(std::shared_ptr<RangeLog> log) : log_(std::move(log)) {}
  RangeWatch(const RangeWatch&) = default;
  RangeWatch& operator=(const RangeWatch&) = default;
  ~RangeWatch() {
    if (log_) log_->add(inputs_);
  }

  void see(const State& state) {
    if (log_) inputs_.add(state);
  }

 private:
  std::shared_ptr<RangeLog> log_;
  InputExtremes inputs_;
};

/// Returns true if a coefficient of the file makes the forces depend on the inflation pressure.
bool pressure_acts(const Parameters& parameters);

}  // namespace latsch::magic_formula
