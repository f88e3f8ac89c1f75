// SPDX-License-Identifier: Apache-2.0
#include "cli/console/implausible.h"

#include "cli/console/console.h"
#include "correlation/analysis/plausibility.h"

namespace latsch::cli {

void reject_implausible(const correlation::Study& study) {
  const auto found = correlation::implausible(study);
  const correlation::Finding* worst = nullptr;
  for (const correlation::Finding& finding : found) {
    if (finding.impossible && !worst) {
      worst = &finding;
      continue;
    }
    warn((finding.impossible ? "also wrong: " : "warning: ") + finding.place.text() + ": " +
             finding.sentence,
         finding.place);
  }
  if (worst) throw InputError(worst->place, worst->sentence);
}

}  // namespace latsch::cli
