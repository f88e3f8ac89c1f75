// SPDX-License-Identifier: Apache-2.0
// Why a search of the residual trust region ended.
#pragma once

#include <string>

namespace latsch {

enum class Ending {
  none,       // it has not
  verified,   // fresh slopes promise nothing
  noise,      // nor do they above noise and ripple
  edge,       // steps that gain fail
  rough,      // steps do not bring what fresh slopes promise
  blind,      // along a direction no slope could be had
  known,      // the model's own slopes promise nothing
  explained,  // next to nothing is left of the residuals
  hopeless    // nothing ever succeeded
};

std::string in_words(Ending ending);

}  // namespace latsch
