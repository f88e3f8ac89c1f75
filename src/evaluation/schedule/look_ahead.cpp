// SPDX-License-Identifier: Apache-2.0
#include "evaluation/schedule/look_ahead.h"

#include <algorithm>

namespace latsch {
namespace {

/// While fewer points are requested, the time for computing all of them is measured again after
/// kAskAgain requests, because it changes during a search. The interval is doubled each time, up to
/// kAskSeldom requests.
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
