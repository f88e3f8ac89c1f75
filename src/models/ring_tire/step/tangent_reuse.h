// SPDX-License-Identifier: Apache-2.0
// Decides whether the tangent of an earlier step is used for this one too. In axes that rotate with
// the rim the tangent changes only as the contact travels along the belt. The change is small in
// steps that rotate the wheel by a fraction of a segment, in which the factorization is most of the
// work. The tangent is held as long as a step with it takes no more evaluations than one with its
// own tangent did. If it fails in the very next step, it is not tried in the following 1, 3, 7 ..
// 31 steps, more each time.
#pragma once

#include <algorithm>

namespace latsch::ring_tire {

class TangentReuse {
 public:
  /// Drops the tangent.
  void forget() { *this = {}; }

  /// Returns true if the kept tangent can be used at the beginning of a step. `acceleration` is the
  /// step's d(acceleration)/d(position), 1/s^2. It must be called once for each step, because it
  /// counts the tangent's age.
  bool serves(double acceleration) {
    ++age_;
    if (wait_ > 0) {
      --wait_;
      return false;
    }
    return acceleration == acceleration_;
  }
  /// Records that a step made its own tangent.
  void made(double acceleration) {
    acceleration_ = acceleration;
    age_ = 0;
  }
  /// Records the number of evaluations of a step with its own tangent alone.
  void took_with_own(int evaluations) { alone_ = evaluations; }
  /// Records the number of evaluations of a step with a tangent held for `held` steps, including
  /// those after it was dropped.
  void took_with_held(int evaluations, int held) {
    constexpr int kLongest = 31;
    if (evaluations <= alone_) return;
    patience_ = held == 1 ? std::min(2 * patience_ + 1, kLongest) : 0;
    wait_ = patience_;
    if (age_ > 0) acceleration_ = 0.0;  // the tangent survived the step, and is dropped now
  }
  int age() const { return age_; }

 private:
  double acceleration_ = 0.0;  // 0: none
  int age_ = 0;                // steps since the tangent was computed
  int alone_ = 0;
  int wait_ = 0, patience_ = 0;
};

}  // namespace latsch::ring_tire
