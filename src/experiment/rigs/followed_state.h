// SPDX-License-Identifier: Apache-2.0
// A number of the rig that the tire drives: the angle of a free wheel's spin by the tire's moment,
// the height of an axle by the tire's load. Its rate at the end of a step is known once the tire
// has taken the step, to where the rig has moved it:
//
//   p1 = y0 + h (3 f0 - f(-1))/2      where the tire is taken [Adams, Bashforth]
//   y1 = y0 + h (f0 + f1)/2           with f1 as the tire answers there [trapezoidal rule]
//
// Order 2 with one step of the tire each. Stable where the tire's answer rings with h omega < 0.6
// or relaxes with h/tau < 0.5: rigs divide steps longer than kLongestStep, at which a wheel may
// ring with 95 Hz.
#pragma once

namespace latsch::experiment {

constexpr double kLongestStep = 1e-3;  // s, of a rig whose wheel or axle the tire moves

class FollowedState {
 public:
  explicit FollowedState(double value) : value_(value) {}

  /// Its rate where it starts.
  void start(double rate) { rate_ = rate_before_ = rate; }
  /// p1.
  double predicted(double h) const { return value_ + h * (1.5 * rate_ - 0.5 * rate_before_); }
  /// The rate at the end of the step, straight on from the last two.
  double predicted_rate() const { return 2.0 * rate_ - rate_before_; }
  /// To y1; `rate`: f1.
  void correct(double h, double rate) {
    value_ += 0.5 * h * (rate_ + rate);
    rate_before_ = rate_;
    rate_ = rate;
  }
  double value() const { return value_; }

 private:
  double value_;
  double rate_ = 0.0, rate_before_ = 0.0;
};

}  // namespace latsch::experiment
