// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/search_ending.h"

namespace latsch {

std::string in_words(Ending ending) {
  switch (ending) {
    case Ending::none:
      return "";
    case Ending::verified:
      return "at a minimum: slopes recomputed around the best point predict no improvement";
    case Ending::noise:
      return "in the noise: slopes recomputed around the best point predict no gain above noise "
             "and ripple of the simulations, or above their curvature if they are exact";
    case Ending::wide:
      return "without having seen a minimum: less than a thousandth of the range of a variable "
             "changes the residuals by more than their size, so their slopes are not known; narrow "
             "its bounds or give it a logarithmic scale";
    case Ending::edge:
      return "at the edge of failed trials: steps that would gain fail";
    case Ending::rough:
      return "on rough or strongly curved ground: steps do not bring the gain that slopes around "
             "the best point predict";
    case Ending::blind:
      return "without having seen a minimum: beside the best point trials fail, or the residuals "
             "change by many times their size however short the step; if the range of a variable "
             "is "
             "that wide, narrow its bounds or give it a logarithmic scale";
    case Ending::known:
      return "at a minimum: the slopes that the model returns predict no improvement";
    case Ending::explained:
      return "with nothing left: less than a ten-thousandth of the first residuals";
    case Ending::hopeless:
      return "without a result: every trial failed";
  }
  return "";
}

}  // namespace latsch
