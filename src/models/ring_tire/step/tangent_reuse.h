// SPDX-License-Identifier: Apache-2.0
// Whether the tangent of an earlier step serves this one too. In axes that turn with the rim it
// changes only as the contact travels along the belt: little in steps that turn the wheel by a
// fraction of a segment, where factorizing is most of the work. It is held as long as a step with
// it takes no more evaluations than one with a tangent of its own did. Where it fails in the very
// next step, it is not tried in the following ones: 1, 3, 7 .. 31 as that goes on.
#pragma once

#include <algorithm>

namespace latsch::ring_tire {

class TangentReuse {
 public:
  /// None is held.
  void forget() { *this = {}; }

  /// At the beginning of a step of that d(acceleration)/d(place), 1/s^2.
  bool serves(double acceleration) {
    ++age_;
    if (wait_ > 0) {
      --wait_;
      return false;
    }
    return acceleration == acceleration_;
  }
  /// A step made its own tangent.
  void made(double acceleration) {
    acceleration_ = acceleration;
    age_ = 0;
  }
  /// At the end of a step: with its own tangent alone it took so many evaluations.
  void took_with_own(int evaluations) { alone_ = evaluations; }
  /// With one `held` for that many steps it took so many, those after it was given up included.
  void took_with_held(int evaluations, int held) {
    constexpr int kLongest = 31;
    if (evaluations <= alone_) return;
    patience_ = held == 1 ? std::min(2 * patience_ + 1, kLongest) : 0;
    wait_ = patience_;
    if (age_ > 0) acceleration_ = 0.0;  // it was not given up: it goes now
  }
  int age() const { return age_; }

 private:
  double acceleration_ = 0.0;  // 0: none
  int age_ = 0;                // steps since it was made
  int alone_ = 0;
  int wait_ = 0, patience_ = 0;
};

}  // namespace latsch::ring_tire
