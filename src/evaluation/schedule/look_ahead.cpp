// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/look_ahead.h"

#include <algorithm>

namespace latsch {
namespace {

/// Number of proposals after which both durations are measured again: they change during a search.
constexpr int kAskAgain = 16;
constexpr int kAskSeldom = 1024;

}  // namespace

int LookAhead::points(double trial) {
  if (ahead_ - alone_ <= trial || trial == 0.0) {
    patience_ = kAskAgain;
    return most_;
  }
  if (++left_out_ < patience_) return 1;
  left_out_ = 0;
  patience_ = std::min(2 * patience_, kAskSeldom);
  return most_;
}

void LookAhead::took(int points, double seconds) { (points == most_ ? ahead_ : alone_) = seconds; }

}  // namespace latsch
