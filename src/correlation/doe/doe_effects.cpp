// SPDX-License-Identifier: Apache-2.0
#include "correlation/doe/doe_effects.h"

#include <map>
#include <optional>
#include <string>

namespace latsch::correlation {

std::vector<ElementaryEffects> doe_effects(const Study& study,
                                           const StudyDesign& design,
                                           const std::vector<RatedTrial>& trials) {
  if (design.kind != DesignKind::morris) return {};
  std::map<std::string, double> targets;  // keyed by the point's bits
  for (const RatedTrial& trial : trials) targets.emplace(trial.point.bits(), trial.target);
  const MorrisDesign trajectories = morris_design(design, study.space);
  std::vector<std::vector<std::optional<double>>> values;
  for (const auto& trajectory : trajectories.trajectories) {
    values.emplace_back();
    for (const DesignPoint& point : trajectory) {
      const auto target = targets.find(point.bits());
      values.back().push_back(target != targets.end() ? std::optional(target->second)
                                                      : std::nullopt);
    }
  }
  return elementary_effects(study.space, trajectories, values);
}

}  // namespace latsch::correlation
