// SPDX-License-Identifier: Apache-2.0
#include "evaluation/look_ahead.h"

namespace latsch {
namespace {

constexpr int kAskAgain = 16;  // proposals: both times change as a search goes on

}  // namespace

int LookAhead::points(double trial) {
  const bool pays = ahead_ - alone_ <= trial || trial == 0.0;
  if (pays || ++left_out_ == kAskAgain) {
    left_out_ = 0;
    return most_;
  }
  return 1;
}

void LookAhead::took(int points, double seconds) {
  (points == most_ ? ahead_ : alone_) = seconds;
}

}  // namespace latsch
