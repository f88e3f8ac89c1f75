// SPDX-License-Identifier: Apache-2.0
// The reason why a search of the residual trust region ended.
#pragma once

#include <string>

namespace latsch {

enum class Ending {
  none,       // not ended
  verified,   // fresh slopes promise nothing
  noise,      // fresh slopes promise nothing above noise and ripple
  edge,       // steps that would gain fail
  rough,      // steps do not gain what fresh slopes promise
  blind,      // along some direction no slope could be computed
  known,      // the model's own slopes promise nothing
  explained,  // almost nothing is left of the residuals
  hopeless    // nothing ever succeeded
};

std::string in_words(Ending ending);

}  // namespace latsch
