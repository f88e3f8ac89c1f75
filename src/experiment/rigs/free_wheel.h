// SPDX-License-Identifier: Apache-2.0
// A wheel that the tire turns: I spin'' = My, and what else turns it.
#pragma once

#include "experiment/rigs/followed_state.h"
#include "models/tire/tire.h"

namespace latsch::experiment {

class FreeWheel {
 public:
  /// At the angle and speed of `motion`; `moment`: all that turns it there, N m.
  FreeWheel(const WheelMotion& motion, double inertia, double moment)
      : inertia_(inertia), angle_(motion.spin), rate_(motion.spin_rate) {
    rate_.start(moment / inertia);
  }

  /// Where the tire is taken in a step of h.
  void predict(double h, WheelMotion& motion) const {
    motion.spin_rate = rate_.predicted(h);
    motion.spin = angle_ + 0.5 * h * (rate_.value() + motion.spin_rate);
  }
  /// To the end of the step, where `moment` is all that turns the wheel, N m.
  void correct(double h, double moment) {
    const double before = rate_.value();
    rate_.correct(h, moment / inertia_);
    angle_ += 0.5 * h * (before + rate_.value());
  }
  double rate() const { return rate_.value(); }  // rad/s

 private:
  double inertia_;  // kg m^2
  double angle_;    // rad
  FollowedState rate_;
};

}  // namespace latsch::experiment
