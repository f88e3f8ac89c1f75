// SPDX-License-Identifier: Apache-2.0
// The reason why a search of the residual trust region ended.
#pragma once

#include <string>

namespace latsch {

enum class Ending {
  none,       // not ended
  verified,   // recomputed slopes predict no gain
  noise,      // recomputed slopes predict no gain above noise and ripple
  edge,       // steps that would gain fail
  rough,      // steps do not achieve the gain that recomputed slopes predict
  blind,      // along some direction no slope could be computed
  known,      // the model's own slopes predict no gain
  explained,  // almost nothing is left of the residuals
  hopeless    // no point ever succeeded
};

std::string in_words(Ending ending);

}  // namespace latsch
