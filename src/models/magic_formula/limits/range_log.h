// SPDX-License-Identifier: Apache-2.0
// Extremes of the inputs that a rolling tire passes to the formula, and the ranges of its file that
// they leave. The formula limits its inputs to these ranges, so its forces beyond them are those at
// the limit, which a user has to know.
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
  Extremes Fz, kappa, alpha, gamma, p, speed;  // SI; speed is |Vx|
  Extremes standing;                           // N, loads of a tire that stands

  void add(const State& state);
  void add(const InputExtremes& other);
};

/// Returns a sentence for every range of the file that was left, and for a load beyond its
/// [DEFLECTION_LOAD_CURVE]; empty if none was. A load below
/// FZMIN and a speed below VXLOW count if they never rise above it, because a tire may lift off and
/// start from rest.
std::vector<std::string> ranges_left(const InputExtremes& inputs, const Parameters& parameters);

/// Collects the extremes of several tires, which may be in several threads.
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

/// Member of a tire that records its inputs and is copied with its state. It passes them to the log
/// at its end, so that inputs of a rejected step, whose tire was overwritten, do not count.
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

/// True if a coefficient of the file lets the forces depend on the inflation pressure.
bool pressure_acts(const Parameters& parameters);

}  // namespace latsch::magic_formula
