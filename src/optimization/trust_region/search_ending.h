// SPDX-License-Identifier: Apache-2.0
// The reason why a search of the residual trust region ended.
#pragma once

#include <string>

namespace latsch {

enum class Ending {
  none,       // not ended
  verified,   // recomputed slopes predict no gain
  noise,      // recomputed slopes predict no gain above noise and ripple
  wide,       // predicts no gain, but a small share of a variable's range explains the scatter
  edge,       // steps that would improve the value fail
  rough,      // steps do not achieve the gain that recomputed slopes predict
  blind,      // the slope along some direction could not be computed
  known,      // the model's own derivatives predict no gain
  explained,  // the remaining residuals are a tiny share of the first ones
  hopeless    // no point has ever succeeded
};

std::string in_words(Ending ending);

}  // namespace latsch
