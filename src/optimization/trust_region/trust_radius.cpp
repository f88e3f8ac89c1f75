// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/trust_radius.h"

#include <algorithm>
#include <cmath>

namespace latsch {

void TrustRadius::judge_step(
    TrustBox& box, const Wanted& step, double gain, bool is_best, bool is_of_center) {
  if (is_good(gain)) disappointments_ = 0;
  if (is_best && is_good(gain)) {
    // A step that only its own small box kept short says nothing against a larger radius.
    const double most =
        std::max(tuning_.most_growth * step.length, step.box < 1.0 ? box.radius : 0.0);
    box.radius = std::clamp(box.radius, tuning_.growth * step.length, most);
    box.radius = std::min(box.radius, tuning_.widest);
  } else if (is_bad(gain) && is_of_center && step.length <= tuning_.own_steps * box.radius) {
    ++disappointments_;
    if (step.f_center - step.predicted < step.deviation) {
      box.radius = std::min(box.radius, tuning_.below_noise * step.radius);
      return;
    }
    // Several steps from the same center may disappoint at once; together they shrink the radius
    // no more than the one that shrinks it most.
    box.radius = std::min(
        box.radius,
        std::clamp(
            step.length, tuning_.most_shrinkage * step.radius, tuning_.shrinkage * step.radius));
    is_geometry_doubted_ = true;
  }
}

void TrustRadius::shrink_after_failure(TrustBox& box, const Wanted& failed) const {
  if (!bears_probes()) {
    box.radius *= tuning_.after_giving_up;
  } else if (failed.kind == Wanted::Kind::step && failures_ >= tuning_.failures_to_shrink) {
    box.radius *= tuning_.after_failures;
  }
}

void TrustRadius::begin(TrustBox& box, double radius) {
  box.radius = radius;
  disappointments_ = 0;
}

bool TrustRadius::widen_if_drowned(TrustBox& box) {
  const bool is_drowned = box.noise >= tuning_.drowned && box.radius < initial_;
  if (!is_drowned || widened_since_outcome_ >= tuning_.widenings_an_outcome) return false;
  ++widened_since_outcome_;
  box.radius *= 2.0;
  return true;
}

bool TrustRadius::widen_in_noise(TrustBox& box) {
  if (box.noise <= 0.0 || box.radius >= initial_) return false;
  if (widenings_ >= tuning_.widenings) return false;
  ++widenings_;
  const double wide = 2.0 * box.radius * std::pow(std::max(1.0, box.noise), 0.25);
  begin(box, std::min(wide, initial_));
  return true;
}

}  // namespace latsch
